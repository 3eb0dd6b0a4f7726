#include "app/cli/render_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "app/base/error.h"
#include "app/base/message.h"
#include "app/cli/camera_path.h"
#include "app/cli/command_options.h"
#include "app/cli/option_groups.h"
#include "app/cli/picture_source.h"
#include "app/cli/suggestions.h"

namespace trisect {

void add_render_options(CLI::App& command, RenderOptions& options, RenderText& text) {
  add_scene(command, options, text.scene);
  command.get_option("MODEL")->required(false);
  command
      .add_option("--from", options.from,
                  "Make this picture again, a .png or .exr of this program: its model and options "
                  "are taken where none are given")
      ->group(option_group::kModel)
      ->check(not_empty())
      ->check(suggest_images())
      ->type_name("FILE");
  command
      .add_option("-o,--output", options.output,
                  "Image to write: .png (8-bit sRGB), .exr (linear float, with AOVs) or .pfm "
                  "(float, one of them); - writes PNG to standard output")
      ->group(option_group::kOutput)
      ->required()
      ->check(not_empty())
      ->check(suggest_files({".png", ".exr", ".pfm"}))
      ->type_name("FILE");
  command
      .add_option("--backend", text.backend,
                  "Who traces: vulkan, opengl, cpu (the same kernel as C++) or oracle (double "
                  "precision, slow), default vulkan")
      ->group(option_group::kTracing)
      ->check(one_of({"vulkan", "opengl", "cpu", "oracle"}))
      ->type_name("NAME");
  command
      .add_option("--aov", text.aovs,
                  "What an EXR holds of each pixel, of color, Z, N, G, patch, uv, P (position) and "
                  "evals, default color,Z,N,G,patch,uv; a PFM holds one of them, default color")
      ->group(option_group::kOutput)
      ->type_name("A,B,...");
  command
      .add_option("--tile", text.tile,
                  "Render this part of the image only, x and y of its top left pixel, width and "
                  "height; trisect stitch puts parts together")
      ->group(option_group::kSequence)
      ->type_name("X,Y,W,H");
  command
      .add_option("--turntable", options.turntable,
                  "N frames, in which the camera goes once around the target; {frame} in the "
                  "names of outputs becomes the frame's number")
      ->group(option_group::kSequence)
      ->check(number_from_to(1, static_cast<int>(kMostFrames)))
      ->type_name("N");
  command
      .add_option("--camera-path", options.camera_path,
                  "Frames along keyframes of a JSON file, see docs/sequences.md")
      ->group(option_group::kSequence)
      ->check(not_empty())
      ->check(suggest_files({".json"}))
      ->type_name("FILE");
  command
      .add_option("--frames", text.frames,
                  "Render frames A to B of those, or frame A alone, counted from 0")
      ->group(option_group::kSequence)
      ->type_name("A:B");
  command.add_flag("--resume", options.resume, "Leave out the frames whose files are there")
      ->group(option_group::kSequence);
  add_validation(command, options.validation);
  add_spp(command, options.spp);
  command
      .add_option("--runs", options.runs,
                  "Frames to time after a warm-up; without it one, which is not preceded by any")
      ->group(option_group::kMeasuring)
      ->check(number_from_to(1, 1000000))
      ->type_name("N");
  command
      .add_flag("--evals", options.evals,
                "Count evaluations of the surface: EXR channel evals, evals_total in the figures")
      ->group(option_group::kMeasuring);
  command.add_option("--stats", options.stats, "Write the figures as JSON")
      ->group(option_group::kOutput)
      ->check(not_empty())
      ->check(suggest_files({".json"}))
      ->type_name("FILE.json");
}

void parse_render(const RenderText& text, RenderOptions& options) {
  parse_scene(text.scene, options);
  if (text.backend) options.backend = backend_named("--backend", *text.backend);
  if (text.aovs) options.aovs = parse_aovs("--aov", *text.aovs);
  if (text.frames) options.frames = parse_frames("--frames", *text.frames);
  if (text.tile) {
    options.tile = parse_part("--tile", *text.tile, options.width, options.height);
  }
  if (options.tile && options.gl_path == GlPath::fragment) {
    throw UsageError("--tile: it needs --gl-path compute.");
  }
}

RenderOptions saved_options(const std::string& file) {
  const SavedPicture picture = saved_picture(file);
  RenderOptions options;
  RenderText text;
  CLI::App command;
  add_render_options(command, options, text);
  command.get_option("--output")->required(false);
  std::vector<std::string> words(picture.words.rbegin(), picture.words.rend());
  const auto refuse = [&](const std::string& fault) {
    throw InputError(
        fmt::format("{}: what it says of how it was made cannot be: {}.", file, reason_of(fault)));
  };
  try {
    command.parse(words);
    parse_render(text, options);
    if (!picture.aovs.empty()) parse_aovs("--aov", picture.aovs);
  } catch (const CLI::ParseError& error) {
    refuse(fault_of(command, error));
  } catch (const UsageError& error) {
    refuse(error.what());
  }
  return options;
}

void give_way(const CLI::App& command, const RenderText& given, RenderOptions& options) {
  const SceneText& scene = given.scene;
  const bool shadows_given = command.count("--shadows") > 0;
  const bool unlit = scene.shading && !is_lit(shading_of(*scene.shading));
  if (unlit) {
    options.color.reset();
    if (options.background == Background::sky) options.background.reset();
  }
  const bool bisects = scene.solver ? *scene.solver == "bisect" : scene.preset.has_value();
  if (!shadows_given && (unlit || bisects)) options.shadows = false;
  if (given.backend && *given.backend != "opengl") options.gl_path = GlPath::compute;
  if (given.backend || scene.solver || scene.preset) options.accel.reset();
  if (scene.size) options.tile.reset();
}

std::optional<std::string> file_to_repeat(const std::vector<std::string>& words) {
  const std::string option = "--from";
  std::optional<std::string> file;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == option && i + 1 < words.size()) file = words[i + 1];
    if (words[i].starts_with(option + "=")) file = words[i].substr(option.size() + 1);
  }
  return file && !file->empty() ? file : std::nullopt;
}

}  // namespace trisect
