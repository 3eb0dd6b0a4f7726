// Inputs that are well, which the fuzzers begin with.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trisect::fuzz {

struct Seed {
  std::string kind;  // of one_input.h: "model", "path", "picture", "text" or "solver"
  std::string content;
};

// Those of every kind. folders: with model files, of which the small ones are taken.
std::vector<Seed> seeds_of(const std::vector<std::filesystem::path>& folders);

}  // namespace trisect::fuzz
