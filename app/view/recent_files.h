// The models that were opened last, kept between runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace trisect::view {

class RecentFiles {
 public:
  // folder: the user's for this program's caches; without one nothing is kept.
  explicit RecentFiles(const std::optional<std::filesystem::path>& folder);

  // The last one first.
  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

  // Puts it first and keeps the list; one that cannot be written is as good as none.
  void add(const std::string& file);

 private:
  std::filesystem::path list_;
  std::vector<std::string> files_;
};

}  // namespace trisect::view
