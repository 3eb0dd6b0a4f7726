#include "app/base/read_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <system_error>

#include "app/base/error.h"
#include "app/base/memory.h"

namespace trisect {
namespace {

class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path)
      : descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~OpenFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  OpenFile(OpenFile&&) = delete;
  OpenFile& operator=(OpenFile&&) = delete;
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

[[noreturn]] void fail_to(const char* what, const std::filesystem::path& path) {
  throw InputError(fmt::format("{}: cannot be {}: {}.", path.string(), what,
                               std::generic_category().message(errno)));
}

// What is known of an opened file. Throws InputError if it is not open, or a directory.
struct stat status_of(const OpenFile& file, const std::filesystem::path& path) {
  struct stat status {};
  if (file.descriptor() < 0 || fstat(file.descriptor(), &status) != 0) fail_to("opened", path);
  if (!S_ISDIR(status.st_mode)) return status;
  throw InputError(path.string() + ": cannot be read: it is a directory.");
}

}  // namespace

void expect_readable_file(const std::filesystem::path& path) {
  status_of(OpenFile(path), path);
}

std::string read_file(const std::filesystem::path& path) {
  const OpenFile file(path);
  const struct stat status = status_of(file, path);
  // The size may not be known, as a pipe's, or be wrong, as in /proc.
  constexpr std::size_t least = 65536;
  std::string bytes;
  if (status.st_size > 0) bytes.reserve(static_cast<std::size_t>(status.st_size) + least);
  for (std::size_t used = 0;;) {
    // Never more than doubled, so that an unknown size costs as much as a known one.
    const std::size_t size = used + std::max(least, std::min(used, bytes.capacity() - used));
    // What has no end, such as /dev/zero, is not read until the system ends the program.
    if (size > bytes.capacity()) expect_memory(2.0 * static_cast<double>(size), path.string());
    bytes.resize(size);
    const ssize_t got = read(file.descriptor(), bytes.data() + used, bytes.size() - used);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_to("read", path);
    used += static_cast<std::size_t>(got);
    if (got == 0) {
      bytes.resize(used);
      return bytes;
    }
  }
}

}  // namespace trisect
