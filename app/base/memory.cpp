#include "app/base/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "app/base/error.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

std::optional<uint64_t> number_in(const fs::path& path) {
  uint64_t number = 0;
  // "max" is no limit.
  if (std::ifstream file(path); file >> number) return number;
  return std::nullopt;
}

std::optional<uint64_t> available_in_machine() {
  std::ifstream file("/proc/meminfo");
  std::string name;
  uint64_t kibibytes = 0;
  for (std::string unit; file >> name >> kibibytes && std::getline(file, unit);) {
    if (name == "MemAvailable:") return kibibytes * 1024;
  }
  return std::nullopt;
}

// The folder of this process's control group, which is in those above it.
fs::path control_group() {
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("0::/")) return fs::path("/sys/fs/cgroup") / line.substr(4);
  }
  return {};
}

std::string gigabytes_text(double bytes) {
  return fmt::format("{:.1f} GB", bytes / 1e9);
}

}  // namespace

std::optional<uint64_t> free_memory() {
  std::optional<uint64_t> least = available_in_machine();
  for (fs::path group = control_group(); group.has_relative_path() && group != "/sys/fs";
       group = group.parent_path()) {
    const std::optional<uint64_t> most = number_in(group / "memory.max");
    const std::optional<uint64_t> used = number_in(group / "memory.current");
    if (!most || !used) continue;
    const uint64_t left = *most - std::min(*used, *most);
    least = std::min(least.value_or(left), left);
  }
  return least;
}

void expect_memory(double bytes, const std::string& what) {
  if (bytes < 0.25e9) return;
  const std::optional<uint64_t> free = free_memory();
  if (!free || bytes <= 0.9 * static_cast<double>(*free)) return;
  throw OutOfMemory(fmt::format("{} needs {} of memory, and {} are free.", what,
                                gigabytes_text(bytes), gigabytes_text(static_cast<double>(*free))));
}

}  // namespace trisect
