// Writes the inputs that the fuzzers begin with, a folder for each kind: make-seeds FOLDER MODELS
// ... MODELS: folders with model files.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/fuzz/seeds.h"

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  if (argc < 3) return 2;
  try {
    const fs::path corpus = argv[1];
    std::size_t count = 0;
    for (const trisect::fuzz::Seed& seed : trisect::fuzz::seeds_of({argv + 2, argv + argc})) {
      fs::create_directories(corpus / seed.kind);
      const fs::path path = corpus / seed.kind / ("seed-" + std::to_string(++count));
      std::ofstream(path, std::ios::binary) << seed.content;
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make-seeds: %s\n", error.what());
    return 1;
  }
}
