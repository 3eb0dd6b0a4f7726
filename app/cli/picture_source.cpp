#include "app/cli/picture_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "app/base/error.h"
#include "app/cli/provenance.h"
#include "app/picture/image_reader.h"

namespace trisect {
namespace {

// The attributes that are options of `render`, by the options' names.
constexpr const char* kOptions[] = {"size",   "tile",   "surface", "alpha",      "shell",
                                    "solver", "rank",   "eye",     "target",     "up",
                                    "fov",    "light",  "color",   "background", "shading",
                                    "spp",    "crease", "weld",    "backend",    "gl_path"};
constexpr const char* kFlags[] = {"shadows", "repair", "evals"};

}  // namespace

std::vector<ImageAttribute> attributes_of(const RenderOptions& options,
                                          const PictureSource& source) {
  const TraceSettings& settings = source.settings;
  std::vector<ImageAttribute> attributes{
      {"program", std::string("trisect ") + TRISECT_VERSION},
      {"commit", commit()},
      {"device", source.device},
      {"driver", source.driver},
      {"backend", std::string(backend_name(options.backend))},
      {"model", options.model},
      {"model_sha256", source.model_sha256},
      {"size", fmt::format("{}x{}", options.width, options.height)},
      {"surface", std::string(surface_name(options.surface))},
      {"alpha", options.alpha},
      {"shell", std::string(shell_name(options.shell))},
      {"solver", std::string(solver_name(options.solver))},
      {"rank", static_cast<int>(options.rank)},
      {"accel", std::string(accel_name(source.accel))},
      {"eye", settings.camera.eye},
      {"target", settings.camera.target},
      {"up", settings.camera.up},
      {"fov", settings.camera.fov},
      {"light", settings.light},
      {"shading", std::string(shading_name(settings.shading))},
      {"background", background_text(settings.background, settings.background_color)},
      {"shadows", static_cast<int>(options.shadows)},
      {"spp", static_cast<int>(options.spp)},
      {"weld", options.mesh.weld},
      {"repair", static_cast<int>(options.mesh.repair)}};
  if (options.backend == Backend::opengl) {
    attributes.push_back({"gl_path", std::string(gl_path_name(options.gl_path))});
  }
  if (options.color) attributes.push_back({"color", *options.color});
  if (options.mesh.crease_degrees) attributes.push_back({"crease", *options.mesh.crease_degrees});
  if (options.evals) attributes.push_back({"evals", 1});
  if (options.tile) attributes.push_back({"tile", part_text(*options.tile)});
  if (!options.aovs.empty()) attributes.push_back({"aov", aovs_text(options.aovs)});
  return attributes;
}

SavedPicture saved_picture(const std::string& file) {
  std::map<std::string, std::string> said;
  for (auto& [name, value] : read_attributes(file)) said[name] = std::move(value);
  if (!said["program"].starts_with("trisect ") || said["model"].empty()) {
    throw InputError(file + ": does not say how it was made.");
  }
  SavedPicture picture{{},
                       said["model"],
                       said["model_sha256"],
                       said["aov"],
                       said["program"],
                       said["commit"],
                       said["device"],
                       said["driver"]};
  for (const char* option : kOptions) {
    if (said[option].empty()) continue;
    std::string name = option;
    std::replace(name.begin(), name.end(), '_', '-');
    picture.words.push_back(fmt::format("--{}={}", name, said[option]));
  }
  for (const char* flag : kFlags) {
    if (said[flag] == "1") picture.words.push_back(fmt::format("--{}", flag));
  }
  // The pixels do not depend on the acceleration, but what it takes to find them does.
  if (said["evals"] == "1") picture.words.push_back("--accel=" + said["accel"]);
  return picture;
}

}  // namespace trisect
