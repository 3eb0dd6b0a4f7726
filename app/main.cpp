// The program: parses the command line, runs a command, turns errors into sentences and exit codes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

#include "app/commands.h"
#include "app/error.h"
#include "app/interrupt.h"
#include "vk/result.h"

namespace trisect {
namespace {

int fail(int code, const std::string& message) {
  std::fprintf(stderr, "trisect: %s\n", message.c_str());
  return code;
}

// Options that CLI11 hands over as text and options.h parses.
struct RenderText {
  std::string surface;
  std::optional<std::string> backend;
  std::optional<std::string> accel;
  std::optional<std::string> gl_path;
  std::optional<std::string> preset;
  std::optional<std::string> shell;
  std::optional<std::string> solver;
  std::optional<std::string> size;
  std::optional<std::string> eye;
  std::optional<std::string> target;
  std::optional<std::string> up;
  std::optional<std::string> light;
};

// Accepts a number from low to high, a whole one if Number is int, and no NaN.
template <typename Number>
CLI::Validator number_from_to(Number low, Number high) {
  return CLI::Validator(
      [low, high](const std::string& text) -> std::string {
        Number value{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool parsed = error == std::errc() && end == text.data() + text.size();
        if (parsed && value >= low && value <= high) return {};
        return fmt::format("'{}' is not a {}number from {} to {}", text,
                           std::is_integral_v<Number> ? "whole " : "", low, high);
      },
      "");
}

CLI::Validator not_empty() {
  return CLI::Validator(
      [](const std::string& text) -> std::string { return text.empty() ? "is empty" : ""; }, "");
}

CLI::Validator one_of(const std::vector<std::string>& names) {
  return CLI::Validator(
      [names](const std::string& text) -> std::string {
        if (std::find(names.begin(), names.end(), text) != names.end()) return {};
        return fmt::format("'{}' is not one of: {}", text, fmt::join(names, ", "));
      },
      "");
}

void add_gl_path(CLI::App& command, std::optional<std::string>& text) {
  command
      .add_option("--gl-path", text,
                  "How OpenGL traces: compute (Vulkan's kernel) or fragment (the thesis's "
                  "full-screen quad), default compute")
      ->check(one_of({"compute", "fragment"}))
      ->type_name("NAME");
}

// What is rendered, from where and how: of `render` and `crosscheck`.
void add_scene(CLI::App* command, RenderOptions& options, RenderText& text) {
  // Of an option that is given twice the last one counts.
  command->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  command->add_option("MODEL", options.model, "OBJ file")->required();
  command->add_option("--size", text.size, "Image size in pixels, default 800x600")
      ->type_name("WxH");
  command
      ->add_option("--surface", text.surface,
                   "How triangles are curved: flat, phong or sphere, default phong")
      ->check(one_of({"flat", "phong", "sphere"}))
      ->type_name("NAME");
  command
      ->add_option("--alpha", options.alpha,
                   "phong: from 0 (flat) to 1 (full projection) and beyond, default 0.65")
      ->check(number_from_to(-1000.0, 1000.0))
      ->type_name("A");
  command
      ->add_option("--shell", text.shell,
                   "Along what they are displaced: normal (watertight) or height (the thesis's), "
                   "default normal")
      ->check(one_of({"normal", "height"}))
      ->type_name("NAME");
  command
      ->add_option("--solver", text.solver,
                   "How roots are found: robust (the first one, surely) or bisect (the thesis's), "
                   "default robust")
      ->check(one_of({"robust", "bisect"}))
      ->type_name("NAME");
  command
      ->add_option(
          "--accel", text.accel,
          "What a ray is tried against: list (every patch, the thesis's), tiles (those "
          "that its tile of the image touches), bvh (those that a tree of boxes finds; both "
          "vulkan, robust) or auto, default auto")
      ->check(one_of({"list", "tiles", "bvh", "auto"}))
      ->type_name("NAME");
  command
      ->add_option("--preset", text.preset,
                   "thesis: --shell height --solver bisect --rank 10, but for what is given beside")
      ->check(one_of({"thesis"}))
      ->type_name("NAME");
  command
      ->add_option("--rank", options.rank,
                   "bisect: resolves a triangle's chord to 2^-N, 1 to 60, default 10")
      ->check(number_from_to(1, 60))
      ->type_name("N");
  command->add_option("--eye", text.eye, "Position of the camera, default: frames the model")
      ->type_name("X,Y,Z");
  command->add_option("--target", text.target, "Point it looks at, default: the model's centre")
      ->type_name("X,Y,Z");
  command->add_option("--up", text.up, "Its up vector, default 0,1,0")->type_name("X,Y,Z");
  command
      ->add_option("--light", text.light,
                   "Direction toward the light, of any length, default 0.35,0.8,0.5")
      ->type_name("X,Y,Z");
  command
      ->add_option("--fov", options.fov,
                   "Its vertical field of view in degrees, 1 to 170, default 45")
      ->check(number_from_to(1.0, 170.0))
      ->type_name("DEG");
  command
      ->add_option("--crease", options.crease,
                   "Rebuild the normals, sharp where faces meet at more than this angle, 0 to 180")
      ->check(number_from_to(0.0, 180.0))
      ->type_name("DEG");
  add_gl_path(*command, text.gl_path);
  command
      ->add_option("--device", options.device,
                   "Vulkan device: its number in `trisect devices` or a part of its name")
      ->check(not_empty())
      ->type_name("D");
}

void add_render(CLI::App& app, RenderOptions& options, RenderText& text) {
  CLI::App* render = app.add_subcommand("render", "Render a model to an image file");
  add_scene(render, options, text);
  render
      ->add_option("-o,--output", options.output,
                   "Image to write: .png (8-bit sRGB) or .exr (linear float, with AOVs)")
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
  render
      ->add_option("--spp", options.spp,
                   "Rays a pixel, averaged in linear light: 1, 4, 9 or 16, default 1")
      ->check(CLI::IsMember({1, 4, 9, 16}))
      ->type_name("N");
  render->add_option("--runs", options.runs, "Frames to time after a warm-up, default 1")
      ->check(number_from_to(1, 1000000))
      ->type_name("N");
  render->add_flag(
      "--evals", options.evals,
      "Count evaluations of the surface: EXR channel evals, evals_total in the figures");
  render->add_option("--stats", options.stats, "Write the figures as JSON")
      ->check(not_empty())
      ->type_name("FILE.json");
}

// The text of `crosscheck`'s own options.
struct CrosscheckText {
  RenderText scene;
  std::optional<std::string> backends;
};

// --json and --diff, of the commands that compare.
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
  add_scene(command, options.render, text.scene);
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

// The text of `accuracy`'s options.
struct AccuracyText {
  std::optional<std::string> size;
  std::optional<std::string> surface;
  std::optional<std::string> shell;
};

void add_accuracy(CLI::App& app, AccuracyOptions& options, AccuracyText& text) {
  CLI::App* command = app.add_subcommand(
      "accuracy", "Compare the solvers with the double-precision oracle, pixel by pixel");
  command->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  command->add_option("MODEL", options.models, "OBJ files")
      ->required()
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--size", text.size, "Image size in pixels, default 800x600")
      ->type_name("WxH");
  command->add_option("--surface", text.surface, "flat, phong or sphere, default phong and sphere")
      ->check(one_of({"flat", "phong", "sphere"}))
      ->type_name("NAME");
  command->add_option("--shell", text.shell, "normal or height, default both")
      ->check(one_of({"normal", "height"}))
      ->type_name("NAME");
  command
      ->add_option("--device", options.device,
                   "Vulkan device: its number in `trisect devices` or a part of its name")
      ->check(not_empty())
      ->type_name("D");
  command->add_option("--json", options.json, "Write the table as JSON")
      ->check(not_empty())
      ->type_name("FILE");
}

uint surface_of(const std::string& name) {
  return name == "flat" ? SURFACE_FLAT : name == "phong" ? SURFACE_PHONG : SURFACE_SPHERE;
}

uint shell_of(const std::string& name) {
  return name == "height" ? SHELL_HEIGHT : SHELL_NORMAL;
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
  hardcases->add_option("--json", options.json, "Write the table as JSON")
      ->check(not_empty())
      ->type_name("FILE");
  hardcases->add_option("--backend", backend, "Who traces: vulkan or cpu, default vulkan")
      ->check(one_of({"vulkan", "cpu"}))
      ->type_name("NAME");
  hardcases
      ->add_option("--device", options.device,
                   "Vulkan device: its number in `trisect devices` or a part of its name")
      ->check(not_empty())
      ->type_name("D");
}

void parse_scene(const RenderText& text, RenderOptions& options) {
  if (!text.surface.empty()) options.surface = surface_of(text.surface);
  if (text.gl_path == "fragment") options.gl_path = GlPath::fragment;
  if (text.preset) {
    options.shell = SHELL_HEIGHT;
    options.solver = SOLVER_BISECT;
  }
  if (text.shell) options.shell = shell_of(*text.shell);
  if (text.solver) options.solver = *text.solver == "bisect" ? SOLVER_BISECT : SOLVER_ROBUST;
  if (text.accel == "list") options.accel = Accel::list;
  if (text.accel == "tiles") options.accel = Accel::tiles;
  if (text.accel == "bvh") options.accel = Accel::bvh;
  if (text.size) parse_size("--size", *text.size, options.width, options.height);
  if (text.eye) options.eye = parse_triple("--eye", *text.eye);
  if (text.target) options.target = parse_triple("--target", *text.target);
  if (text.up) options.up = parse_triple("--up", *text.up);
  if (text.light) options.light = parse_direction("--light", *text.light);
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
  HardcasesOptions hardcases_options;
  std::string hardcases_backend;
  add_hardcases(app, hardcases_options, hardcases_backend);
  CrosscheckOptions crosscheck_options;
  CrosscheckText crosscheck_text;
  add_crosscheck(app, crosscheck_options, crosscheck_text);
  CompareOptions compare_options;
  std::vector<std::string> thresholds;
  add_compare(app, compare_options, thresholds);
  app.add_subcommand("devices", "List the Vulkan devices, and what those that cannot be used lack");
  app.footer(
      "Exit codes: 0 done, 1 farther apart than promised, 2 usage, 3 bad input, 4 no usable "
      "device, 70 internal error, "
      "130 interrupted.");
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
  if (app.got_subcommand("devices")) return list_devices();
  if (app.got_subcommand("accuracy")) return run_accuracy(accuracy_options, accuracy_text);
  if (app.got_subcommand("crosscheck")) return run_crosscheck(crosscheck_options, crosscheck_text);
  if (app.got_subcommand("compare")) return run_compare(compare_options, thresholds);
  if (app.got_subcommand("hardcases")) {
    if (hardcases_backend == "cpu") hardcases_options.backend = Backend::cpu;
    return hardcases(hardcases_options);
  }
  parse_scene(text, options);
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
  } catch (const gpu::Error& error) {
    return fail(exit_no_device, error.what());
  } catch (const Interrupted& error) {
    return fail(exit_interrupted, error.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_bad_input, "not enough memory for this model and image size.");
  } catch (const std::exception& error) {
    return fail(exit_internal, std::string("internal error: ") + error.what());
  }
}
