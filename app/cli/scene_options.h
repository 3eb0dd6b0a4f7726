// What is rendered, from where and how: the options that `render` and `crosscheck` share.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "app/cli/options.h"

namespace trisect {

// Options that CLI11 hands over as text and options.h parses, and the rank, of which --preset has
// a say, too.
struct SceneText {
  std::string surface;
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
};

// MODEL, which must be given, the options of add_view, --gl-path and --device. `options` and `text`
// must outlive the parse; what stands in `options` stays if nothing is given.
void add_scene(CLI::App& command, RenderOptions& options, SceneText& text);

// How it is rendered. Of an option that is given twice the last one counts, of those that the
// command gets later, too.
void add_view(CLI::App& command, RenderOptions& options, SceneText& text);

// --spp.
void add_spp(CLI::App& command, uint32_t& spp);

// Lays what was given over `options`. Throws UsageError, naming the option, for a value that is
// none and for options that do not go together.
void parse_scene(const SceneText& text, RenderOptions& options);

}  // namespace trisect
