// The script of `trisect view --script`: commands and when they are due.
#pragma once

#include <string>
#include <vector>

namespace trisect::view {

struct ScriptStep {
  double seconds = 0.0;  // after the third frame was shown
  std::string command;
  std::string argument;  // the rest of the line
};

// Reads lines "SECONDS COMMAND ARGUMENT", in any order of time; empty lines and those that begin
// with # are ignored. Commands: `hold KEY SECONDS` and `press KEY` (a letter, a digit, space,
// shift, tab, escape, f5 or f12), `flags FLAGS` (of `trisect render`), `shown NAME`, `size WxH` (of
// the window), `open FILE`, `save FILE`, `error`, `quit`. Steps wait while kernels are made.
// Returns the steps in the order of time; those of the same time stay in the order of the file.
// Throws InputError, naming the file and the line, for any other line.
std::vector<ScriptStep> read_script(const std::string& file);

// GLFW_KEY_... of the key with that name; -1 if there is none.
int key_named(const std::string& name);

}  // namespace trisect::view
