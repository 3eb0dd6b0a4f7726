#include "app/base/atomic_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>

#include "app/base/error.h"

namespace trisect {

AtomicFile::AtomicFile(const std::filesystem::path& target) : target_(target) {
  const auto fail = [&](const std::string& why) {
    throw InputError(fmt::format("{}: cannot be written: {}.", target.string(), why));
  };
  std::error_code error;
  if (std::filesystem::is_symlink(target_, error)) {
    target_ = std::filesystem::weakly_canonical(target_, error);
    if (error) fail(error.message());
  }
  const std::filesystem::file_status status = std::filesystem::status(target_, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    fail("it is not a regular file");
  }
  std::string name = target_.string() + ".XXXXXX";
  const int file = mkstemp(name.data());
  if (file < 0) fail(std::generic_category().message(errno));
  temporary_ = name;
  // mkstemp lets only the owner read the file. Give it the permissions of the file it replaces, or
  // those of any new file.
  const mode_t mask = umask(0);
  umask(mask);
  const mode_t mode = std::filesystem::exists(status)
                          ? static_cast<mode_t>(status.permissions() & std::filesystem::perms::mask)
                          : mode_t{0666} & ~mask;
  fchmod(file, mode);
  close(file);
}

AtomicFile::~AtomicFile() {
  std::error_code unused;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, unused);
}

void AtomicFile::write(std::string_view text) const {
  std::ofstream file(temporary_, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.close();
  if (!file) throw InputError(target_.string() + ": could not be written whole.");
}

void AtomicFile::commit() {
  std::error_code error;
  std::filesystem::rename(temporary_, target_, error);
  if (error) {
    throw InputError(fmt::format("{}: cannot be written: {}.", target_.string(), error.message()));
  }
  temporary_.clear();
}

}  // namespace trisect
