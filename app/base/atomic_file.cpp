#include "app/base/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "app/base/error.h"
#include "app/base/folder_of.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

// The name of a temporary file in the target's folder, as mkstemp() takes it.
std::string temporary_name(const fs::path& target) {
  return (folder_of(target) / ".trisect-XXXXXX").string();
}

// A descriptor of a file without a name in that folder; -1 where there cannot be any.
int open_unnamed(const fs::path& folder) {
  // Without /proc it could get no name later.
  if (access("/proc/self/fd", X_OK) != 0) return -1;
  return open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
}

// Gives the file of a descriptor a name that nothing has. Returns 0, or errno.
int link_as(int file, const fs::path& name) {
  const std::string path = fmt::format("/proc/self/fd/{}", file);
  return linkat(AT_FDCWD, path.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0 ? 0 : errno;
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& target) : target_(target) {
  std::error_code error;
  if (fs::is_symlink(target_, error)) {
    target_ = fs::weakly_canonical(target_, error);
    if (error) fail(error.value());
  }
  const fs::file_status status = fs::status(target_, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw InputError(target_.string() + ": cannot be written: it is not a regular file.");
  }
  unnamed_ = open_unnamed(folder_of(target_));
  int file = unnamed_;
  if (has_name()) {
    std::string name = temporary_name(target_);
    file = mkstemp(name.data());
    if (file < 0) fail(errno);
    temporary_ = name;
  } else {
    temporary_ = fmt::format("/proc/{}/fd/{}", getpid(), unnamed_);
  }
  // So far only the owner may read it. Give it the permissions of the file it replaces, or those of
  // any new file.
  const mode_t mask = umask(0);
  umask(mask);
  const mode_t mode = fs::exists(status)
                          ? static_cast<mode_t>(status.permissions() & fs::perms::mask)
                          : mode_t{0666} & ~mask;
  fchmod(file, mode);
  if (has_name()) close(file);
}

AtomicFile::~AtomicFile() {
  std::error_code unused;
  if (!has_name()) {
    close(unnamed_);
  } else if (!temporary_.empty()) {
    fs::remove(temporary_, unused);
  }
}

void AtomicFile::write(std::string_view text) const {
  std::ofstream file(temporary_, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file) throw InputError(target_.string() + ": could not be written whole.");
}

void AtomicFile::commit() {
  if (!has_name()) {
    const int error = link_as(unnamed_, target_);
    if (error != 0 && error != EEXIST) fail(error);
    if (error == 0) {
      close(std::exchange(unnamed_, -1));
      temporary_.clear();
      return;
    }
    // Only a file with a name can take the place of another: mkstemp() finds a name that is free,
    // if only for a moment.
    std::string name = temporary_name(target_);
    const int placeholder = mkstemp(name.data());
    if (placeholder < 0) fail(errno);
    close(placeholder);
    unlink(name.c_str());
    if (const int again = link_as(unnamed_, name); again != 0) fail(again);
    close(std::exchange(unnamed_, -1));
    temporary_ = name;
  }
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) fail(error.value());
  temporary_.clear();
}

void AtomicFile::fail(int error) const {
  throw InputError(fmt::format("{}: cannot be written: {}.", target_.string(),
                               std::generic_category().message(error)));
}

}  // namespace trisect
