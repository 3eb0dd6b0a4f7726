#include "app/view/kernel_source.h"

#include <algorithm>
#include <system_error>

#include "app/view/kernel_compiler.h"

namespace trisect::view {
namespace {

constexpr double kSecondsBetweenLooks = 0.25;

std::filesystem::file_time_type last_write_in(const std::filesystem::path& folder) {
  // Not 0, as the epoch of this clock may lie in the future.
  auto last = std::filesystem::file_time_type::min();
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    last = std::max(last, entry.last_write_time(error));
  }
  return last;
}

}  // namespace

KernelSource::KernelSource(std::string folder)
    : folder_(std::move(folder)), last_write_(last_write_in(folder_)) {}

std::shared_ptr<const KernelCode> KernelSource::compile() const {
  return std::make_shared<const KernelCode>(compile_kernels(folder_));
}

bool KernelSource::has_changed(Clock::time_point now) {
  if (seconds_between(last_look_, now) < kSecondsBetweenLooks) return false;
  last_look_ = now;
  const auto last_write = last_write_in(folder_);
  const bool has_changed = last_write != last_write_;
  last_write_ = last_write;
  return has_changed;
}

}  // namespace trisect::view
