#include "app/base/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "app/base/error.h"
#include "app/base/folder_of.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

// Of a new file, less the umask.
constexpr mode_t kNewFile = 0666;

// A descriptor of a file without a name in that folder; -1 where there cannot be any.
int open_unnamed(const fs::path& folder) {
  // Without /proc it could get no name later.
  if (access("/proc/self/fd", X_OK) != 0) return -1;
  return open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, kNewFile);
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
  if (unnamed_ < 0) {
    make_name();
    temporary_ = name_->path();
  } else {
    temporary_ = fmt::format("/proc/{}/fd/{}", getpid(), unnamed_);
  }
  // A file that is replaced keeps its permissions.
  if (fs::exists(status)) fs::permissions(temporary_, status.permissions(), error);
}

AtomicFile::~AtomicFile() {
  if (unnamed_ >= 0) close(unnamed_);
}

void AtomicFile::make_name() {
  try {
    name_.emplace(folder_of(target_), kNewFile);
  } catch (const std::system_error& error) {
    fail(error.code().value());
  }
}

void AtomicFile::write(std::string_view text) const {
  write_parts([&](std::ostream& file) {
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
  });
}

void AtomicFile::write_parts(const std::function<void(std::ostream& file)>& put) const {
  std::ofstream file(temporary_, std::ios::binary);
  put(file);
  file.close();
  if (!file) throw InputError(target_.string() + ": could not be written whole.");
}

void AtomicFile::commit() {
  if (unnamed_ >= 0) {
    const int error = link_as(unnamed_, target_);
    if (error != 0 && error != EEXIST) fail(error);
    if (error != 0) {
      // Only a file with a name can take the place of another: one is made to find a name that is
      // free.
      make_name();
      unlink(name_->path().c_str());
      if (const int again = link_as(unnamed_, name_->path()); again != 0) fail(again);
    }
    close(std::exchange(unnamed_, -1));
  }
  if (name_) {
    std::error_code error;
    fs::rename(name_->path(), target_, error);
    if (error) fail(error.value());
    name_->release();
  }
}

void AtomicFile::fail(int error) const {
  throw InputError(fmt::format("{}: cannot be written: {}.", target_.string(),
                               std::generic_category().message(error)));
}

}  // namespace trisect
