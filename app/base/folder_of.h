// The folder of a file.
#pragma once

#include <filesystem>

namespace trisect {

// Where a file is: "." for one without a folder.
inline std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace trisect
