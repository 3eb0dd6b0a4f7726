// Temporary files, known to the whole process, so that one that has to end at once leaves none.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>

namespace trisect {

// A new, empty file of its own name, removed by the destructor. The first 64 of a process that are
// there at a time are removed by remove_temporary_files() too.
class TemporaryName {
 public:
  // In this folder; its name begins with `.trisect-`. mode: its permissions, less the umask. Throws
  // std::system_error if it cannot be made.
  TemporaryName(const std::filesystem::path& folder, mode_t mode);
  ~TemporaryName();
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;
  TemporaryName(TemporaryName&&) = delete;
  TemporaryName& operator=(TemporaryName&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  // The file is no longer temporary: it has got another name.
  void release();

 private:
  std::filesystem::path path_;  // empty: released
  std::size_t slot_;
};

// Removes the files of every TemporaryName, in whichever thread it is. For a process that ends
// right after it. A signal handler may call it.
void remove_temporary_files() noexcept;

}  // namespace trisect
