#include "app/cli/cache_folder.h"

#include <cstdlib>

namespace trisect {

std::optional<std::filesystem::path> cache_folder() {
  // The specification says to ignore relative paths.
  const auto absolute = [](const char* name) -> std::filesystem::path {
    const char* value = std::getenv(name);
    const std::filesystem::path path(value == nullptr ? "" : value);
    return path.is_absolute() ? path : std::filesystem::path();
  };
  if (const auto cache = absolute("XDG_CACHE_HOME"); !cache.empty()) return cache / "trisect";
  if (const auto home = absolute("HOME"); !home.empty()) return home / ".cache" / "trisect";
  return std::nullopt;
}

}  // namespace trisect
