#include "app/view/flags.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <vector>

#include "app/base/error.h"
#include "app/base/number_text.h"
#include "app/cli/command_options.h"
#include "app/cli/load_scene.h"
#include "app/cli/scene_options.h"
#include "app/dispatch/accel.h"

namespace trisect::view {
namespace {

// Each number is the shortest text of its value, as parse_triple() reads doubles directly.
std::string triple(const glm::dvec3& value) {
  return fmt::format("{},{},{}", value.x, value.y, value.z);
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), std::istream_iterator<std::string>()};
}

// Whether the words begin with "trisect render", the program being in any folder.
bool names_command(const std::vector<std::string>& words) {
  return words.size() >= 2 && words[1] == "render" &&
         std::filesystem::path(words[0]).filename() == "trisect";
}

}  // namespace

std::string flags_of(const RenderOptions& options) {
  std::string text =
      fmt::format("--size {}x{} --surface {} --alpha {} --shell {} --solver {}", options.width,
                  options.height, surface_name(options.surface), number_text(options.alpha),
                  shell_name(options.shell), solver_name(options.solver));
  const auto add = [&text](const char* option, const std::string& value) {
    text += fmt::format(" {} {}", option, value);
  };
  if (options.solver == SOLVER_BISECT) add("--rank", std::to_string(options.rank));
  if (options.accel) add("--accel", accel_name(*options.accel));
  if (options.eye) add("--eye", triple(*options.eye));
  if (options.target) add("--target", triple(*options.target));
  // Compared as texts: -0 equals 0 as a number, but renders other bits.
  const std::string up = triple(options.up);
  if (up != triple(RenderOptions{}.up)) add("--up", up);
  add("--fov", number_text(options.fov));
  if (options.light) add("--light", triple(*options.light));
  if (options.shadows) text += " --shadows";
  if (options.shading) add("--shading", shading_name(*options.shading));
  if (options.color) add("--color", triple(*options.color));
  if (options.background) {
    add("--background", background_text(*options.background, options.background_color));
  }
  if (options.spp != 1) add("--spp", std::to_string(options.spp));
  const MeshOptions& mesh = options.mesh;
  if (mesh.crease_degrees) add("--crease", number_text(*mesh.crease_degrees));
  if (mesh.weld > 0.0) add("--weld", number_text(mesh.weld));
  if (mesh.repair) text += " --repair";
  return text;
}

RenderOptions with_flags(const RenderOptions& base, const std::string& text) {
  RenderOptions options = base;
  options.shadows = false;
  options.spp = 1;
  options.accel.reset();
  options.shading.reset();
  options.color.reset();
  options.background.reset();
  options.background_color = glm::dvec3(0.0);
  std::vector<std::string> words = words_of(text);
  if (names_command(words)) words.erase(words.begin(), words.begin() + 2);
  CLI::App command;
  command.set_help_flag();  // --help is refused like any unknown option
  SceneText scene;
  add_view(command, options, scene);
  add_spp(command, options.spp);
  std::string ignored;
  command.add_option("MODEL", ignored);
  command.add_option("-o,--output", ignored);
  std::reverse(words.begin(), words.end());  // CLI11 takes them from the end
  try {
    command.parse(words);
  } catch (const CLI::ParseError& error) {
    throw UsageError(fault_of(command, error));
  }
  parse_scene(scene, options);
  // Refuses options that do not go together, whatever the model.
  chosen_accel(accel_request(options, true), Backend::vulkan, 1);
  return options;
}

}  // namespace trisect::view
