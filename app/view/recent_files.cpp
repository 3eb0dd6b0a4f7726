#include "app/view/recent_files.h"

#include <algorithm>
#include <fstream>
#include <system_error>

#include "app/base/atomic_file.h"
#include "app/base/error.h"

namespace trisect::view {
namespace {

constexpr std::size_t kMost = 8;

}  // namespace

RecentFiles::RecentFiles(const std::optional<std::filesystem::path>& folder) {
  if (!folder) return;
  list_ = *folder / "recent-models";
  std::ifstream in(list_);
  for (std::string line; files_.size() < kMost && std::getline(in, line);) {
    if (!line.empty()) files_.push_back(line);
  }
}

void RecentFiles::add(const std::string& file) {
  std::error_code error;
  const std::string whole = std::filesystem::absolute(file, error).string();
  if (error || whole.find('\n') != std::string::npos) return;
  std::erase(files_, whole);
  files_.insert(files_.begin(), whole);
  files_.resize(std::min(files_.size(), kMost));
  if (list_.empty()) return;
  std::filesystem::create_directories(list_.parent_path(), error);
  std::string text;
  for (const std::string& one : files_) text += one + "\n";
  try {
    AtomicFile out(list_);
    out.write(text);
    out.commit();
  } catch (const InputError&) {
    return;
  }
}

}  // namespace trisect::view
