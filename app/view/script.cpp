#include "app/view/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <utility>

#include "app/base/error.h"
#include "app/base/read_file.h"
#include "app/cli/options.h"
#include "app/picture/image_file.h"
#include "app/view/flags.h"
#include "app/view/panel.h"
#include "app/view/window.h"

namespace trisect::view {
namespace {

std::string in_quotes(const std::string& text) {
  return "'" + text + "'";
}

// What is wrong with a step; empty if nothing is.
std::string fault_of(const ScriptStep& step) {
  std::istringstream words(step.argument);
  std::string word;
  words >> word;
  if (step.command == "hold" || step.command == "press") {
    double seconds = 0.0;
    if (key_named(word) < 0) return in_quotes(word) + " is not a key";
    if (step.command == "hold" && !(words >> seconds)) return "hold needs a number of seconds";
    return {};
  }
  if (step.command == "shown") {
    return shown_named(step.argument) ? "" : in_quotes(step.argument) + " is not an output";
  }
  if (step.command == "error" || step.command == "quit") return {};
  constexpr std::array<std::string_view, 4> with_argument{"flags", "size", "open", "save"};
  if (std::find(with_argument.begin(), with_argument.end(), step.command) == with_argument.end()) {
    return in_quotes(step.command) + " is not a command";
  }
  if (step.argument.empty()) return step.command + " needs an argument";
  try {
    uint32_t width = 0;
    uint32_t height = 0;
    if (step.command == "size") {
      parse_size("size", step.argument, width, height);
    } else if (step.command == "flags") {
      with_flags({}, step.argument);
    } else if (step.command == "save") {
      image_format(step.argument);
    }
  } catch (const UsageError& error) {
    std::string fault = error.what();
    if (fault.back() == '.') fault.pop_back();
    return fault;
  }
  return {};
}

}  // namespace

int key_named(const std::string& name) {
  constexpr std::array<std::pair<std::string_view, int>, 6> named{{{"space", GLFW_KEY_SPACE},
                                                                   {"shift", GLFW_KEY_LEFT_SHIFT},
                                                                   {"tab", GLFW_KEY_TAB},
                                                                   {"escape", GLFW_KEY_ESCAPE},
                                                                   {"f5", GLFW_KEY_F5},
                                                                   {"f12", GLFW_KEY_F12}}};
  for (const auto& entry : named) {
    if (entry.first == name) return entry.second;
  }
  if (name.size() != 1) return -1;
  // GLFW's key codes of letters and digits are ASCII, of capital letters.
  const char c = name[0];
  if (c >= 'a' && c <= 'z') return c - 'a' + 'A';
  return c >= '0' && c <= '9' ? c : -1;
}

std::vector<ScriptStep> read_script(const std::string& file) {
  std::istringstream in(read_file(file));
  std::vector<ScriptStep> steps;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    std::string first;
    if (!(words >> first) || first[0] == '#') continue;
    ScriptStep step;
    std::istringstream time(first);
    const auto refuse = [&](const std::string& why) {
      throw InputError(fmt::format("{}, line {}: {}.", file, number, why));
    };
    if (!(time >> step.seconds) || !time.eof() || !(step.seconds >= 0.0)) {
      refuse(fmt::format("'{}' is not a number of seconds", first));
    }
    words >> step.command >> std::ws;
    std::getline(words, step.argument);
    step.argument.erase(step.argument.find_last_not_of(" \t\r") + 1);
    const std::string fault = fault_of(step);
    if (!fault.empty()) refuse(fault);
    steps.push_back(std::move(step));
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const ScriptStep& a, const ScriptStep& b) { return a.seconds < b.seconds; });
  return steps;
}

}  // namespace trisect::view
