// The folder for files that the program can make again, such as compiled pipelines.
#pragma once

#include <filesystem>
#include <optional>

namespace trisect {

// $XDG_CACHE_HOME/trisect, or ~/.cache/trisect; nothing if neither variable holds an absolute path
// (XDG Base Directory Specification 0.8).
std::optional<std::filesystem::path> cache_folder();

}  // namespace trisect
