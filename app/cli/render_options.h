// The options of `trisect render`.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/cli/scene_options.h"

namespace trisect {

// Values of options as CLI11 hands them over, which parse_render() parses.
struct RenderText {
  SceneText scene;
  std::optional<std::string> backend;
  std::optional<std::string> aovs;
  std::optional<std::string> tile;
  std::optional<std::string> frames;
};

// Adds all options of the command. `options` and `text` must outlive the parse; `options` holds the
// defaults.
void add_render_options(CLI::App& command, RenderOptions& options, RenderText& text);

// Parses what was given into `options`. Throws UsageError, naming the option, for a malformed value
// and for options that exclude each other.
void parse_render(const RenderText& text, RenderOptions& options);

// The options that make the picture of a file again, but for its model and what it holds of each
// pixel. Throws InputError, naming the file, if it does not say them, or says what cannot be.
RenderOptions saved_options(const std::string& file);

// To be called between the parse of a command whose options began as saved_options(), and
// parse_render(): takes back those saved options that do not go with what was given.
void give_way(const CLI::App& command, const RenderText& given, RenderOptions& options);

// The file of --from in the words of a command, if there is one.
std::optional<std::string> file_to_repeat(const std::vector<std::string>& words);

}  // namespace trisect
