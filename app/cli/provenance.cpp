#include "app/cli/provenance.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <ctime>

#include "commit.h"

namespace trisect {

std::string commit() {
  return TRISECT_COMMIT;
}

std::string program_and_date() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("trisect {}, commit {}, compiled by {}, {:%Y-%m-%d}", TRISECT_VERSION,
                     TRISECT_COMMIT, TRISECT_COMPILER, fmt::gmtime(now));
}

}  // namespace trisect
