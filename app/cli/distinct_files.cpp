#include "app/cli/distinct_files.h"

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <system_error>

#include "app/base/error.h"

namespace trisect {
namespace {

void expect_other(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return;
  std::error_code error;
  const auto resolved = [&](const std::string& path) {
    return std::filesystem::weakly_canonical(path, error);
  };
  if (resolved(a) == resolved(b)) {
    throw UsageError(fmt::format("{} and {} are the same file.", a, b));
  }
}

}  // namespace

void expect_distinct(const std::vector<std::string>& read,
                     const std::vector<std::string>& written) {
  for (std::size_t i = 0; i < written.size(); ++i) {
    for (const std::string& other : read) expect_other(written[i], other);
    for (std::size_t k = 0; k < i; ++k) expect_other(written[i], written[k]);
  }
}

}  // namespace trisect
