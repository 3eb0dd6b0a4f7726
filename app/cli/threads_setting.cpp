#include "app/cli/threads_setting.h"

#include <fmt/format.h>

#include <cstdlib>
#include <optional>
#include <string_view>

#include "app/base/error.h"
#include "app/base/number_text.h"
#include "app/base/threads.h"

namespace trisect {

void take_threads_setting() {
  constexpr unsigned most = 1024;
  const char* setting = std::getenv("TRISECT_THREADS");
  if (setting == nullptr) return;
  const std::string_view text = setting;
  const std::optional<unsigned> threads = parse_number<unsigned>(text);
  if (!threads || *threads < 1 || *threads > most) {
    throw UsageError(
        fmt::format("TRISECT_THREADS is '{}': a whole number from 1 to {} is wanted.", text, most));
  }
  set_worker_threads(*threads);
}

}  // namespace trisect
