// Where the program keeps what it may lose.
#pragma once

#include <filesystem>
#include <optional>

namespace trisect {

// $XDG_CACHE_HOME/trisect, or ~/.cache/trisect; nothing if there is neither (XDG Base Directory
// Specification 0.8).
std::optional<std::filesystem::path> cache_folder();

}  // namespace trisect
