#include "app/program/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "app/base/error.h"
#include "app/bench/command_line.h"
#include "app/cli/command_options.h"
#include "app/cli/commands.h"
#include "app/cli/option_groups.h"
#include "app/cli/output.h"
#include "app/cli/render_options.h"
#include "app/cli/scene_options.h"
#include "app/cli/standard_output.h"
#include "app/cli/suggestions.h"
#include "app/judge/hard_rays.h"
#include "app/program/help_format.h"
#include "app/view/command_line.h"

namespace trisect {
namespace {

using Command = CommandLine::Command;

// A command whose parsed options are `Values`.
template <typename Values>
struct Added {
  CLI::App& command;
  std::shared_ptr<Values> values;
};

// The last of a repeated option counts, also of those that the command gets later.
template <typename Values>
Added<Values> add_command(CLI::App& app, const std::string& name, const std::string& what) {
  CLI::App* command = app.add_subcommand(name, what);
  command->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  return {*command, std::make_shared<Values>()};
}

// Adds --quiet to a command or, if it has some, to its own.
void add_quiet(CLI::App& command) {
  const std::vector<CLI::App*> own = command.get_subcommands({});
  for (CLI::App* sub : own) add_quiet(*sub);
  if (own.empty()) {
    command.add_flag_callback("-q,--quiet", be_quiet, "Say nothing but what is wrong")
        ->group(option_group::kOutput);
  }
}

// CLI11 gives every command a --help of its own, in a group of its own.
void group_help(CLI::App& command) {
  command.get_help_ptr()->group(option_group::kHelp);
  for (CLI::App* sub : command.get_subcommands({})) group_help(*sub);
}

void add_model(CLI::App& command, std::string& model) {
  command.add_option("MODEL", model, "OBJ, glTF, PLY, STL or FBX file")
      ->group(option_group::kModel)
      ->required()
      ->check(not_empty())
      ->check(suggest_models());
}

Command add_render(CLI::App& app) {
  struct Values {
    RenderOptions options;
    RenderText text;
    bool repeats = false;  // the options began as those of a picture
  };
  const auto [command, values] =
      add_command<Values>(app, "render", "Render a model to an image file");
  add_render_options(command, values->options, values->text);
  const auto before = [values = values](const std::vector<std::string>& words) {
    const std::optional<std::string> file = file_to_repeat(words);
    if (file) values->options = saved_options(*file);
    values->repeats = file.has_value();
  };
  const auto run = [values = values, &command = command] {
    if (values->repeats) give_way(command, values->text, values->options);
    parse_render(values->text, values->options);
    return render(values->options);
  };
  return {&command, run, before};
}

Command add_stitch(CLI::App& app) {
  const auto [command, options] = add_command<StitchOptions>(
      app, "stitch", "Put the parts of an image together that render --tile has made");
  command.add_option("PART", options->parts, "Images, all PNG or all EXR")
      ->group(option_group::kInput)
      ->required()
      ->check(not_empty())
      ->check(suggest_images())
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_option("-o,--output", options->output, "Image to write, of the same format")
      ->group(option_group::kOutput)
      ->required()
      ->check(not_empty())
      ->check(suggest_images())
      ->type_name("FILE");
  return {&command, [options = options] { return stitch_parts(*options); }};
}

Command add_accuracy(CLI::App& app) {
  struct Values {
    AccuracyOptions options;
    std::optional<std::string> size;
    std::optional<std::string> surface;
    std::optional<std::string> shell;
  };
  const auto [command, values] = add_command<Values>(
      app, "accuracy", "Compare the solvers with the double-precision oracle, pixel by pixel");
  add_models(command, values->options.models);
  add_size(command, values->size, "800x600");
  add_surfaces(command, values->surface);
  command
      .add_option("--shell", values->shell,
                  "Along what triangles are displaced: normal or height, default both")
      ->group(option_group::kSurface)
      ->check(one_of({"normal", "height"}))
      ->type_name("NAME");
  add_device(command, values->options.device);
  add_table_json(command, values->options.json);
  return {&command, [values = values] {
            AccuracyOptions& options = values->options;
            if (values->size) parse_size("--size", *values->size, options.width, options.height);
            if (values->surface) options.surfaces = {surface_of(*values->surface)};
            if (values->shell) options.shells = {shell_of(*values->shell)};
            return accuracy(options);
          }};
}

Command add_hardcases(CLI::App& app) {
  struct Values {
    HardcasesOptions options;
    std::string backend;
  };
  const auto [command, values] =
      add_command<Values>(app, "hardcases", "Measure the solvers on a catalogue of hard cases");
  add_table_json(command, values->options.json);
  command.add_option("--backend", values->backend, "Who traces: vulkan or cpu, default vulkan")
      ->group(option_group::kTracing)
      ->check(one_of({"vulkan", "cpu"}))
      ->type_name("NAME");
  add_device(command, values->options.device);
  return {&command, [values = values] {
            if (values->backend == "cpu") values->options.backend = Backend::cpu;
            return hardcases(values->options);
          }};
}

// Adds --json and --diff to a command that compares frames.
void add_comparison_files(CLI::App& command, std::string& json, std::string& diff) {
  add_json(command, json, "Write the figures as JSON");
  command
      .add_option("--diff", diff,
                  "Write a picture (.png or .exr): both images, their difference amplified, and "
                  "where hits, triangles or Z differ")
      ->group(option_group::kOutput)
      ->check(not_empty())
      ->check(suggest_images())
      ->type_name("FILE");
}

Command add_crosscheck(CLI::App& app) {
  struct Values {
    CrosscheckOptions options;
    SceneText scene;
    std::optional<std::string> backends;
  };
  const auto [command, values] = add_command<Values>(
      app, "crosscheck", "Render a model with several back ends and compare the frames");
  add_scene(command, values->options.render, values->scene);
  command
      .add_option("--backends", values->backends,
                  "Two or more of vulkan, opengl, cpu, oracle, default vulkan,opengl")
      ->group(option_group::kTracing)
      ->type_name("A,B,...");
  add_comparison_files(command, values->options.json, values->options.diff);
  return {&command, [values = values] {
            CrosscheckOptions& options = values->options;
            parse_scene(values->scene, options.render);
            if (values->backends) {
              options.backends = parse_backends("--backends", *values->backends);
            }
            return crosscheck(options);
          }};
}

Command add_certify(CLI::App& app) {
  struct Values {
    CertifyOptions options;
    SceneText scene;
  };
  const auto [command, values] = add_command<Values>(
      app, "certify", "Render a model and prove of each pixel what its ray hits");
  CertifyOptions& options = values->options;
  add_traced_scene(command, options.render, values->scene);
  command
      .add_option_function<std::string>(
          "--backend",
          [values = values](const std::string& name) {
            values->options.render.backend = backend_named("--backend", name);
          },
          "Whose answers are held against the proofs: vulkan, opengl, cpu or oracle, default "
          "vulkan")
      ->group(option_group::kTracing)
      ->check(one_of({"vulkan", "opengl", "cpu", "oracle"}))
      ->type_name("NAME");
  command
      .add_option("-o,--output", options.picture,
                  "Write the reason of each pixel as a picture, .png or .exr")
      ->group(option_group::kOutput)
      ->check(not_empty())
      ->check(suggest_images())
      ->type_name("FILE");
  add_json(command, options.json, "Write the figures as JSON");
  return {&command, [values = values] {
            parse_scene(values->scene, values->options.render);
            return certify(values->options);
          }};
}

Command add_compare(CLI::App& app) {
  struct Values {
    CompareOptions options;
    std::vector<std::string> thresholds;
  };
  const auto [command, values] =
      add_command<Values>(app, "compare", "Compare two images, PNG or EXR, of the same size");
  command.add_option("A", values->options.a, "An image")
      ->group(option_group::kInput)
      ->required()
      ->check(not_empty())
      ->check(suggest_images());
  command.add_option("B", values->options.b, "Another, of the same size")
      ->group(option_group::kInput)
      ->required()
      ->check(not_empty())
      ->check(suggest_images());
  command
      .add_option("--threshold", values->thresholds,
                  "The most of it that is well: hit_mismatches and patch_mismatches (parts of the "
                  "pixels, default 0), color_max and alpha_max (8-bit steps, default 1), "
                  "color_rmse, z_differs (part of the hits), nan_pixels (part of the pixels; these "
                  "three default anything)")
      ->group(option_group::kMeasuring)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("NAME=X");
  command
      .add_flag("--exact", values->options.exact,
                "Every number of every channel must have the same bits")
      ->group(option_group::kMeasuring);
  add_comparison_files(command, values->options.json, values->options.diff);
  return {&command, [values = values] {
            for (const std::string& threshold : values->thresholds) {
              parse_threshold("--threshold", threshold, values->options.tolerance);
            }
            return compare_images(values->options);
          }};
}

Command add_info(CLI::App& app) {
  struct Values {
    InfoOptions options;
    std::optional<std::string> surface;
  };
  const auto [command, values] = add_command<Values>(
      app, "info",
      "Say what a model is like, what its curved surfaces will be like, and what to look at");
  add_model(command, values->options.model);
  add_mesh_options(command, values->options.mesh);
  command
      .add_option("--surface", values->surface,
                  "How triangles are curved: phong or sphere, default phong")
      ->group(option_group::kSurface)
      ->check(one_of({"phong", "sphere"}))
      ->type_name("NAME");
  add_json(command, values->options.json, "Write it as JSON");
  return {&command, [values = values] {
            if (values->surface) values->options.surface = surface_of(*values->surface);
            return info(values->options);
          }};
}

Command add_export(CLI::App& app) {
  const auto [command, values] = add_command<ExportOptions>(
      app, "export", "Write a model's curved surface as flat triangles, for other programs");
  ExportOptions& options = *values;
  add_model(command, options.model);
  command.add_option("-o,--output", options.output, "File to write: .obj, .ply, .stl or .glb")
      ->group(option_group::kOutput)
      ->check(not_empty())
      ->check(suggest_files({".obj", ".ply", ".stl", ".glb"}))
      ->required()
      ->type_name("FILE");
  add_mesh_options(command, options.mesh);
  add_surface(command, options.surface);
  add_alpha(command, options.alpha);
  // Not a group of CLI11's, of which one must be given: after one of those an empty word never
  // ends.
  CLI::Option* subdivide = command
                               .add_option("--subdivide", options.subdivide,
                                           "N x N flat triangles for each of the model's")
                               ->group(option_group::kSurface)
                               ->check(number_from_to(1, 4000))
                               ->type_name("N");
  command
      .add_option("--error", options.error,
                  "As many as it takes to be off the surface by no more than this, in the model's "
                  "units")
      ->group(option_group::kSurface)
      ->check(number_from_to(1e-300, 1e9))
      ->excludes(subdivide)
      ->type_name("EPS");
  add_json(command, options.json, "Write the figures as JSON");
  return {&command, [values = values] {
            if (!values->subdivide && !values->error) {
              throw UsageError("--subdivide or --error is required (see trisect --help)");
            }
            return export_mesh(*values);
          }};
}

// Adds MODEL and what its surface is to a command that exchanges rays.
void add_single_model(CLI::App& command, SingleModel& model) {
  add_model(command, model.file);
  add_mesh_options(command, model.mesh);
  add_surface(command, model.surface);
  command
      .add_option_function<std::string>(
          "--shell", [&model](const std::string& name) { model.shell = shell_of(name); },
          "Along what triangles are displaced: normal or height, default normal")
      ->group(option_group::kSurface)
      ->check(one_of({"normal", "height"}))
      ->type_name("NAME");
  add_alpha(command, model.alpha);
}

// Adds a file of rays or hits that is read.
void add_list(CLI::App& command, const std::string& name, std::string& file,
              const std::string& what) {
  command.add_option(name, file, what)
      ->group(option_group::kRays)
      ->required()
      ->check(not_empty())
      ->check(suggest_files({}));
}

void add_output(CLI::App& command, std::string& output, const std::string& what) {
  command.add_option("-o,--output", output, what)
      ->group(option_group::kOutput)
      ->required()
      ->check(not_empty())
      ->check(suggest_files({}))
      ->type_name("FILE");
}

Command add_rays(CLI::App& app) {
  const auto [command, options] = add_command<RaysOptions>(
      app, "rays", "Write rays on which ray tracers fail, for any program to cast");
  add_single_model(command, options->model);
  add_output(command, options->output, "File of rays to write: .csv is text, any other binary");
  std::vector<std::string> kinds{"all"};
  std::string list;
  for (const RayKind& kind : kRayKinds) {
    kinds.emplace_back(kind.name);
    list += fmt::format("{} ({}), ", kind.name, kind.what);
  }
  command.add_option("--kind", options->kind, list + "or all, each in turn, default all")
      ->group(option_group::kMeasuring)
      ->check(one_of(kinds))
      ->type_name("NAME");
  command.add_option("--count", options->count, "Rays of each kind, default 1000")
      ->group(option_group::kMeasuring)
      ->check(number_from_to(1, 100000000))
      ->type_name("N");
  command.add_option("--seed", options->seed, "Other rays of the same kind, default 1")
      ->group(option_group::kMeasuring)
      ->check(number_from_to(0, 2000000000))
      ->type_name("N");
  return {&command, [options = options] { return write_rays(*options); }};
}

Command add_cast(CLI::App& app) {
  const auto [command, options] =
      add_command<CastOptions>(app, "cast", "Write what the rays of a file hit first");
  add_list(command, "RAYS", options->rays, "File of rays");
  add_single_model(command, options->model);
  add_output(command, options->output, "File of hits to write: .csv is text, any other binary");
  command
      .add_option_function<std::string>(
          "--backend",
          [options = options](const std::string& name) {
            options->backend = backend_named("--backend", name);
          },
          "Who casts: vulkan, cpu or oracle, default vulkan")
      ->group(option_group::kTracing)
      ->check(one_of({"vulkan", "cpu", "oracle"}))
      ->type_name("NAME");
  add_device(command, options->device);
  return {&command, [options = options] { return cast_rays(*options); }};
}

Command add_judge(CLI::App& app) {
  const auto [command, options] = add_command<JudgeOptions>(
      app, "judge", "Judge the hits that any program found for the rays of a file");
  add_list(command, "RAYS", options->rays, "File of rays");
  add_list(command, "HITS", options->hits, "File of hits, one for each ray");
  add_single_model(command, options->model);
  add_json(command, options->json, "Write the figures as JSON");
  command.add_option("--wrong", options->wrong, "Write the rays with a wrong answer as CSV")
      ->group(option_group::kOutput)
      ->check(not_empty())
      ->check(suggest_files({".csv"}))
      ->type_name("FILE");
  return {&command, [options = options] { return judge_hits(*options); }};
}

Command add_devices(CLI::App& app) {
  const auto [command, options] = add_command<DevicesOptions>(
      app, "devices", "List the Vulkan devices, and what those that cannot be used lack");
  command
      .add_flag("--floats", options->floats,
                "Measure what the arithmetic of usable devices does: errors, contraction, "
                "denormals, NaN")
      ->group(option_group::kMeasuring);
  add_device(command, options->device);
  add_table_json(command, options->json);
  return {&command, [options = options] { return list_devices(*options); }};
}

// Of a command that adds itself: bench and view.
template <typename Other>
Command add_other(CLI::App& app, const std::string& name) {
  const auto other = std::make_shared<Other>(app);
  return {app.get_subcommand(name), [other] { return other->run(); }};
}

}  // namespace

CommandLine::CommandLine()
    : app_("Ray-trace triangle models as smooth curved surfaces, in a Vulkan compute shader",
           "trisect") {
  app_.set_version_flag("--version", std::string("trisect ") + TRISECT_VERSION,
                        "Print the version and exit")
      ->group(option_group::kHelp);
  app_.require_subcommand(1);
  // Commands inherit both. They are in the order in which help lists them.
  app_.formatter(std::make_shared<HelpFormat>());
  app_.set_help_flag("-h,--help", "Print this help and exit")->group(option_group::kHelp);
  commands_ = {add_render(app_),
               add_other<view::CommandLine>(app_, "view"),
               add_stitch(app_),
               add_info(app_),
               add_export(app_),
               add_devices(app_),
               add_compare(app_),
               add_crosscheck(app_),
               add_accuracy(app_),
               add_certify(app_),
               add_hardcases(app_),
               add_rays(app_),
               add_cast(app_),
               add_judge(app_),
               add_other<bench::CommandLine>(app_, "bench")};
  for (CLI::App* command : app_.get_subcommands({})) {
    if (command->get_name() != "view") add_quiet(*command);
  }
  group_help(app_);
}

bool CommandLine::parse(int argc, const char* const* argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const auto is_named = [&](const CLI::App* command) { return command->get_name() == words[0]; };
  if (!words.empty() && !words[0].starts_with('-') && app_.get_subcommands(is_named).empty()) {
    throw UsageError(fmt::format("'{}' is not a command (see trisect --help)", words[0]));
  }
  const bool asks_help = std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return word == "-h" || word == "--help";
  });
  for (const Command& command : commands_) {
    const bool is_this = !words.empty() && command.parsed->get_name() == words[0];
    if (command.before && is_this && !asks_help) command.before(words);
  }
  std::reverse(words.begin(), words.end());  // CLI11 takes them from the end
  try {
    app_.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      std::ostringstream text;
      app_.exit(error, text, text);
      write_standard_output(text.str());
      return false;
    }
    throw UsageError(fault_of(app_, error) + " (see trisect --help)");
  }
  return true;
}

int CommandLine::run(int argc, const char* const* argv) {
  if (!parse(argc, argv)) return exit_done;
  for (const Command& command : commands_) {
    if (command.parsed->parsed()) return command.run();
  }
  return exit_usage;  // not reached: one command is required
}

}  // namespace trisect
