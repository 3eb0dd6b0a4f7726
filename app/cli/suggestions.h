// What a shell offers for the value of an option when the user asks it to complete a line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace trisect {

struct Suggestions {
  enum class Kind { nothing, names, files, folders };
  Kind kind = Kind::nothing;
  // The names; or how the names of the files end, nothing for any file.
  std::vector<std::string> words;
};

// These say what to offer, and accept every value: CLI11 has no other place at an option for it.
CLI::Validator suggest_names(const std::vector<std::string>& names);
CLI::Validator suggest_files(const std::vector<std::string>& endings);
CLI::Validator suggest_models();
CLI::Validator suggest_images();
CLI::Validator suggest_folders();

// Gives a check the names that it accepts, to be offered.
CLI::Validator suggesting(CLI::Validator check, const std::vector<std::string>& names);

// What was said at the option, nothing if nothing was.
Suggestions suggestions_of(const CLI::Option& option);

}  // namespace trisect
