// What a script has a window do, and when.
#pragma once

#include <string>
#include <vector>

namespace trisect::view {

struct ScriptStep {
  double seconds = 0.0;  // since the third frame
  std::string command;
  std::string argument;  // the rest of the line
};

// Lines "SECONDS COMMAND ARGUMENT", in any order of time; empty lines and those that begin with #
// are passed over. Commands: `hold KEY SECONDS` and `press KEY` (a letter, a digit, space, shift,
// tab, escape, f5 or f12), `flags FLAGS` (of `trisect render`), `shown NAME`, `size WxH` (the
// window's), `open FILE`, `save FILE`, `error`, `quit`. Returns them in the order of time. Throws
// InputError, naming the file and the line, for what is not such a line.
std::vector<ScriptStep> read_script(const std::string& file);

// GLFW's number of a key of that name; -1 if there is none.
int key_named(const std::string& name);

}  // namespace trisect::view
