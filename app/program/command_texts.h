// What help and manual say that is in no table of options.
#pragma once

#include <string>
#include <vector>

namespace trisect {

struct Example {
  std::string what;  // it does; without a full stop
  std::string line;  // to be typed
};

struct CommandTexts {
  std::vector<std::string> description;  // paragraphs
  std::vector<Example> examples;
};

// Of "trisect render". Empty for a path that is no command's.
CommandTexts command_texts(const std::string& path);

// A name with what it stands for.
struct Term {
  std::string name;
  std::string text;
};

// What the program ends with.
std::vector<Term> exit_codes();
// Environment variables that count.
std::vector<Term> environment();
// Files that the program reads or keeps.
std::vector<Term> files();

}  // namespace trisect
