#include "app/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "app/error.h"

namespace trisect {

AtomicFile::AtomicFile(std::filesystem::path target) : target_(std::move(target)) {
  std::error_code unused;
  if (std::filesystem::is_directory(target_, unused)) {
    throw InputError(target_.string() + ": is a directory, not a file to write.");
  }
  temporary_ = target_;
  temporary_ += fmt::format(".{}.tmp", getpid());
  if (!std::ofstream(temporary_)) {
    throw InputError(fmt::format("{}: cannot be written: {}.", target_.string(),
                                 std::generic_category().message(errno)));
  }
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
