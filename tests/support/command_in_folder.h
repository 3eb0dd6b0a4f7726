// Commands of the program that write into a folder, and what is in it afterwards.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace trisect::test {

// What prepare_outputs() writes.
inline constexpr const char* kBefore = "what was there before";

struct CommandInFolder {
  std::vector<std::string> words;    // in_folder() says what FOLDER/ stands for
  std::vector<std::string> outputs;  // names in the folder
};

// The words with FOLDER/ at the beginning of one replaced by the folder.
std::vector<std::string> in_folder(const std::vector<std::string>& words,
                                   const std::filesystem::path& folder);

// Has each output hold kBefore.
void prepare_outputs(const CommandInFolder& command, const std::filesystem::path& folder);

// The contents of the files in a folder and those below it, by their paths in it.
std::map<std::string, std::string> files_in(const std::filesystem::path& folder);

// The upper and the lower half of an image as PNG files, for commands that read pictures.
class TwoParts {
 public:
  // size: of the image's sides, even.
  explicit TwoParts(int size);

  [[nodiscard]] CommandInFolder stitched() const;
  // The first one with itself.
  [[nodiscard]] CommandInFolder compared() const;

 private:
  TemporaryFolder folder_;
  std::vector<std::string> names_;
};

// Rays at an asset and what they hit, for commands that read lists of them.
class RayLists {
 public:
  // count: of rays of each of the kinds of hard_rays().
  RayLists(const std::string& asset, std::size_t count);

  [[nodiscard]] CommandInFolder cast() const;  // on the CPU
  [[nodiscard]] CommandInFolder judged() const;

 private:
  TemporaryFolder folder_;
  std::string model_;
  std::string rays_;
  std::string hits_;
};

}  // namespace trisect::test
