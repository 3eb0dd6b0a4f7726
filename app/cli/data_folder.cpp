#include "app/cli/data_folder.h"

#include <system_error>

namespace trisect {

namespace fs = std::filesystem;

fs::path data_folder(const fs::path& program, const std::string& name,
                     const fs::path& in_source_tree) {
  const fs::path installed = program.parent_path().parent_path() / "share" / "trisect" / name;
  std::error_code error;
  return fs::is_directory(installed, error) ? installed : in_source_tree;
}

fs::path data_folder(const std::string& name, const fs::path& in_source_tree) {
  std::error_code error;
  return data_folder(fs::read_symlink("/proc/self/exe", error), name, in_source_tree);
}

}  // namespace trisect
