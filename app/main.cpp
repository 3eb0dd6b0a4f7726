// The program: parses the command line, runs a command, turns errors into sentences and exit codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/bench/command_line.h"
#include "app/cli/command_options.h"
#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/output.h"
#include "app/cli/scene_options.h"
#include "app/view/command_line.h"

namespace trisect {
namespace {

int fail(int code, const std::string& message) {
  std::fprintf(stderr, "trisect: %s\n", message.c_str());
  return code;
}

// Adds --quiet to a command and its own.
void add_quiet(CLI::App& command) {
  const std::vector<CLI::App*> own = command.get_subcommands({});
  for (CLI::App* sub : own) add_quiet(*sub);
  if (own.empty()) {
    command.add_flag_callback("-q,--quiet", be_quiet, "Say nothing but what is wrong");
  }
}

// Values of `render`'s own options, as text that is parsed after CLI11 is done.
struct RenderText {
  SceneText scene;
  std::optional<std::string> backend;
};

void add_render(CLI::App& app, RenderOptions& options, RenderText& text) {
  CLI::App* render = app.add_subcommand("render", "Render a model to an image file");
  add_scene(*render, options, text.scene);
  render
      ->add_option(
          "-o,--output", options.output,
          "Image to write: .png (8-bit sRGB) or .exr (linear float, with AOVs); - writes PNG to "
          "standard output")
      ->required()
      ->type_name("FILE");
  render
      ->add_option("--backend", text.backend,
                   "Who traces: vulkan, opengl, cpu (the same kernel as C++) or oracle (double "
                   "precision, slow), default vulkan")
      ->check(one_of({"vulkan", "opengl", "cpu", "oracle"}))
      ->type_name("NAME");
  render->add_flag("--validation", options.validation,
                   "Run under the Vulkan validation layer, fail on any message");
  add_spp(*render, options.spp);
  render
      ->add_option("--runs", options.runs,
                   "Frames to time after a warm-up; without it one, which is not preceded by any")
      ->check(number_from_to(1, 1000000))
      ->type_name("N");
  render->add_flag(
      "--evals", options.evals,
      "Count evaluations of the surface: EXR channel evals, evals_total in the figures");
  render->add_option("--stats", options.stats, "Write the figures as JSON")
      ->check(not_empty())
      ->type_name("FILE.json");
}

// The same of `crosscheck`.
struct CrosscheckText {
  SceneText scene;
  std::optional<std::string> backends;
};

// Adds --json and --diff to a command that compares frames.
void add_comparison_files(CLI::App* command, std::string& json, std::string& diff) {
  command->add_option("--json", json, "Write the figures as JSON")
      ->check(not_empty())
      ->type_name("FILE");
  command
      ->add_option("--diff", diff,
                   "Write a picture (.png or .exr): both images, their difference amplified, and "
                   "where hits, triangles or Z differ")
      ->check(not_empty())
      ->type_name("FILE");
}

void add_crosscheck(CLI::App& app, CrosscheckOptions& options, CrosscheckText& text) {
  CLI::App* command = app.add_subcommand(
      "crosscheck", "Render a model with several back ends and compare the frames");
  add_scene(*command, options.render, text.scene);
  command
      ->add_option("--backends", text.backends,
                   "Two or more of vulkan, opengl, cpu, oracle, default vulkan,opengl")
      ->type_name("A,B,...");
  add_comparison_files(command, options.json, options.diff);
}

void add_compare(CLI::App& app, CompareOptions& options, std::vector<std::string>& thresholds) {
  CLI::App* command =
      app.add_subcommand("compare", "Compare two images, PNG or EXR, of the same size");
  command->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  command->add_option("A", options.a, "Image")->required();
  command->add_option("B", options.b, "Image")->required();
  command
      ->add_option("--threshold", thresholds,
                   "The most of it that is well: hit_mismatches and patch_mismatches (parts of the "
                   "pixels, default 0), color_max (8-bit steps, default 1), color_rmse, z_differs "
                   "(part of the hits, both default anything)")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("NAME=X");
  add_comparison_files(command, options.json, options.diff);
}

// The same of `accuracy`.
struct AccuracyText {
  std::optional<std::string> size;
  std::optional<std::string> surface;
  std::optional<std::string> shell;
};

void add_accuracy(CLI::App& app, AccuracyOptions& options, AccuracyText& text) {
  CLI::App* command = app.add_subcommand(
      "accuracy", "Compare the solvers with the double-precision oracle, pixel by pixel");
  command->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  add_models(*command, options.models);
  add_size(*command, text.size, "800x600");
  add_surfaces(*command, text.surface);
  command->add_option("--shell", text.shell, "normal or height, default both")
      ->check(one_of({"normal", "height"}))
      ->type_name("NAME");
  add_device(*command, options.device);
  add_table_json(*command, options.json);
}

int run_accuracy(AccuracyOptions options, const AccuracyText& text) {
  if (text.size) parse_size("--size", *text.size, options.width, options.height);
  if (text.surface) options.surfaces = {surface_of(*text.surface)};
  if (text.shell) options.shells = {shell_of(*text.shell)};
  return accuracy(options);
}

void add_hardcases(CLI::App& app, HardcasesOptions& options, std::string& backend) {
  CLI::App* hardcases =
      app.add_subcommand("hardcases", "Measure the solvers on a catalogue of hard cases");
  hardcases->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  add_table_json(*hardcases, options.json);
  hardcases->add_option("--backend", backend, "Who traces: vulkan or cpu, default vulkan")
      ->check(one_of({"vulkan", "cpu"}))
      ->type_name("NAME");
  add_device(*hardcases, options.device);
}

void add_info(CLI::App& app, InfoOptions& options, std::optional<std::string>& surface) {
  CLI::App* command = app.add_subcommand(
      "info",
      "Say what a model is like, what its curved surfaces will be like, and what to look at");
  command->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  command->add_option("MODEL", options.model, "OBJ, glTF, PLY, STL or FBX file")->required();
  add_mesh_options(*command, options.mesh);
  command->add_option("--surface", surface, "Of which: phong or sphere, default phong")
      ->check(one_of({"phong", "sphere"}))
      ->type_name("NAME");
  command->add_option("--json", options.json, "Write it as JSON")
      ->check(not_empty())
      ->type_name("FILE");
}

void add_export(CLI::App& app, ExportOptions& options, std::optional<std::string>& surface) {
  CLI::App* command = app.add_subcommand(
      "export", "Write a model's curved surface as flat triangles, for other programs");
  command->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  command->add_option("MODEL", options.model, "OBJ, glTF, PLY, STL or FBX file")->required();
  command->add_option("-o,--output", options.output, "File to write: .obj, .ply, .stl or .glb")
      ->required()
      ->type_name("FILE");
  add_mesh_options(*command, options.mesh);
  command->add_option("--surface", surface, "Of which: flat, phong or sphere, default phong")
      ->check(one_of({"flat", "phong", "sphere"}))
      ->type_name("NAME");
  add_alpha(*command, options.alpha);
  CLI::Option_group* how = command->add_option_group("how fine");
  how->add_option("--subdivide", options.subdivide, "N x N flat triangles for each of the model's")
      ->check(number_from_to(1, 4000))
      ->type_name("N");
  how->add_option("--error", options.error,
                  "As many as it takes to be off the surface by no more than this, in the model's "
                  "units")
      ->check(number_from_to(1e-300, 1e9))
      ->type_name("EPS");
  how->require_option(1);
  command->add_option("--json", options.json, "Write the figures as JSON")
      ->check(not_empty())
      ->type_name("FILE");
}

void add_devices(CLI::App& app, DevicesOptions& options) {
  CLI::App* command = app.add_subcommand(
      "devices", "List the Vulkan devices, and what those that cannot be used lack");
  command->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  command->add_flag("--floats", options.floats,
                    "Measure what the arithmetic of usable devices does: errors, contraction, "
                    "denormals, NaN");
  add_device(*command, options.device);
  add_table_json(*command, options.json);
}

int run_crosscheck(CrosscheckOptions options, const CrosscheckText& text) {
  parse_scene(text.scene, options.render);
  if (text.backends) options.backends = parse_backends("--backends", *text.backends);
  return crosscheck(options);
}

int run_compare(CompareOptions options, const std::vector<std::string>& thresholds) {
  for (const std::string& threshold : thresholds) {
    parse_threshold("--threshold", threshold, options.tolerance);
  }
  return compare_images(options);
}

int run(int argc, char** argv) {
  CLI::App app("Ray-traces triangle models as smooth curved surfaces, in a Vulkan compute shader.",
               "trisect");
  app.set_version_flag("--version", std::string("trisect ") + TRISECT_VERSION);
  app.require_subcommand(1);
  RenderOptions options;
  RenderText text;
  add_render(app, options, text);
  AccuracyOptions accuracy_options;
  AccuracyText accuracy_text;
  add_accuracy(app, accuracy_options, accuracy_text);
  bench::CommandLine bench(app);
  view::CommandLine view(app);
  HardcasesOptions hardcases_options;
  std::string hardcases_backend;
  add_hardcases(app, hardcases_options, hardcases_backend);
  CrosscheckOptions crosscheck_options;
  CrosscheckText crosscheck_text;
  add_crosscheck(app, crosscheck_options, crosscheck_text);
  CompareOptions compare_options;
  std::vector<std::string> thresholds;
  add_compare(app, compare_options, thresholds);
  InfoOptions info_options;
  std::optional<std::string> info_surface;
  add_info(app, info_options, info_surface);
  ExportOptions export_options;
  std::optional<std::string> export_surface;
  add_export(app, export_options, export_surface);
  DevicesOptions devices_options;
  add_devices(app, devices_options);
  for (CLI::App* command : app.get_subcommands({})) {
    if (command->get_name() != "view") add_quiet(*command);
  }
  app.footer(
      "Exit codes: 0 done, 1 farther apart than promised, 2 usage, 3 bad input, 4 no usable "
      "device, 5 device lost, 6 out of memory, 70 internal error, 130 interrupted.");
  const auto is_named = [&](const CLI::App* command) { return command->get_name() == argv[1]; };
  if (argc > 1 && argv[1][0] != '-' && app.get_subcommands(is_named).empty()) {
    throw UsageError(fmt::format("'{}' is not a command (see trisect --help)", argv[1]));
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    return fail(exit_usage, std::string(error.what()) + " (see trisect --help)");
  }
  if (app.got_subcommand("info")) {
    if (info_surface) info_options.surface = surface_of(*info_surface);
    return info(info_options);
  }
  if (app.got_subcommand("export")) {
    if (export_surface) export_options.surface = surface_of(*export_surface);
    return export_mesh(export_options);
  }
  if (app.got_subcommand("devices")) return list_devices(devices_options);
  if (app.got_subcommand("accuracy")) return run_accuracy(accuracy_options, accuracy_text);
  if (app.got_subcommand("bench")) return bench.run();
  if (app.got_subcommand("view")) return view.run();
  if (app.got_subcommand("crosscheck")) return run_crosscheck(crosscheck_options, crosscheck_text);
  if (app.got_subcommand("compare")) return run_compare(compare_options, thresholds);
  if (app.got_subcommand("hardcases")) {
    if (hardcases_backend == "cpu") hardcases_options.backend = Backend::cpu;
    return hardcases(hardcases_options);
  }
  parse_scene(text.scene, options);
  if (text.backend) options.backend = backend_named("--backend", *text.backend);
  return render(options);
}

}  // namespace
}  // namespace trisect

int main(int argc, char** argv) {
  using namespace trisect;  // NOLINT(google-build-using-namespace): main's own
  try {
    catch_interrupts();
    return run(argc, argv);
  } catch (const UsageError& error) {
    return fail(exit_usage, error.what());
  } catch (const InputError& error) {
    return fail(exit_bad_input, error.what());
  } catch (const DeviceLost& error) {
    return fail(exit_device_lost, error.what());
  } catch (const OutOfMemory& error) {
    return fail(exit_out_of_memory, error.what());
  } catch (const DeviceError& error) {
    return fail(exit_no_device, error.what());
  } catch (const Interrupted& error) {
    return fail(exit_interrupted, error.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_out_of_memory, kNoMemory);
  } catch (const std::exception& error) {
    return fail(exit_internal, std::string("internal error: ") + error.what());
  }
}
