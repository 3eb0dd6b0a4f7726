// The list of the models that were opened last, kept between runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace trisect::view {

class RecentFiles {
 public:
  // folder: where the list is kept, the user's cache folder for this program; without one it is not
  // kept.
  explicit RecentFiles(const std::optional<std::filesystem::path>& folder);

  // Absolute paths, at most eight, the last one first.
  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

  // Puts the file first and writes the list. If that fails, the list is only good for this run: it
  // is a convenience, and no reason for an error.
  void add(const std::string& file);

 private:
  std::filesystem::path list_;
  std::vector<std::string> files_;
};

}  // namespace trisect::view
