// Standard output, and whether there is one.
#pragma once

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <string_view>
#include <system_error>

#include "app/base/error.h"

namespace trisect {

// Throws InputError if not all of it can be written.
inline void write_standard_output(std::string_view bytes) {
  errno = 0;
  const std::size_t written = std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  if (written == bytes.size() && std::fflush(stdout) == 0) return;
  throw InputError(fmt::format("standard output: cannot be written: {}.",
                               std::generic_category().message(errno)));
}

// To be called before any file is opened. A program that is started with a standard file closed
// would open another in its place, and what it prints would go there: now it is one that can be
// neither read nor written.
inline void keep_standard_files() {
  for (int file = 0; file <= 2; ++file) {
    if (fcntl(file, F_GETFD) < 0) open("/dev/null", file == 0 ? O_WRONLY : O_RDONLY);
  }
}

}  // namespace trisect
