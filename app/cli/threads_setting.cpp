#include "app/cli/threads_setting.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "app/base/error.h"
#include "app/base/threads.h"

namespace trisect {

void take_threads_setting() {
  constexpr unsigned most = 1024;
  const char* setting = std::getenv("TRISECT_THREADS");
  if (setting == nullptr) return;
  const std::string_view text = setting;
  unsigned threads = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), threads);
  if (error != std::errc() || end != text.data() + text.size() || threads < 1 || threads > most) {
    throw UsageError(
        fmt::format("TRISECT_THREADS is '{}': a whole number from 1 to {} is wanted.", text, most));
  }
  set_worker_threads(threads);
}

}  // namespace trisect
