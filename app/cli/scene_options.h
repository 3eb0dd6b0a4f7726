// The options that `render` and `crosscheck` share: the model, the camera, how rays are traced.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "app/cli/options.h"

namespace trisect {

// Values of options as CLI11 hands them over, which parse_scene() parses. The rank is here because
// --preset sets it unless --rank is given.
struct SceneText {
  std::optional<std::string> accel;
  std::optional<std::string> gl_path;
  std::optional<std::string> preset;
  std::optional<uint32_t> rank;
  std::optional<std::string> shell;
  std::optional<std::string> solver;
  std::optional<std::string> size;
  std::optional<std::string> eye;
  std::optional<std::string> target;
  std::optional<std::string> up;
  std::optional<std::string> light;
  std::optional<std::string> shading;
  std::optional<std::string> background;
  std::optional<std::string> color;
};

// The constant for a name of --shading, which one_of() has checked.
uint shading_of(const std::string& name);

// Adds MODEL, which is required, the options of add_view, --gl-path and --device. `options` and
// `text` must outlive the parse; `options` holds the defaults.
void add_scene(CLI::App& command, RenderOptions& options, SceneText& text);

// The same without the options that change colours alone.
void add_traced_scene(CLI::App& command, RenderOptions& options, SceneText& text);

// Adds the options that say how a model is rendered. The last of a repeated option counts, also for
// options that the command gets later.
void add_view(CLI::App& command, RenderOptions& options, SceneText& text);

// Adds --crease, --weld and --repair.
void add_mesh_options(CLI::App& command, MeshOptions& mesh);

// Adds --spp.
void add_spp(CLI::App& command, uint32_t& spp);

// Parses what was given into `options`. Throws UsageError, naming the option, for a malformed value
// and for options that exclude each other.
void parse_scene(const SceneText& text, RenderOptions& options);

}  // namespace trisect
