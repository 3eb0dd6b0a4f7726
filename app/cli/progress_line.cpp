#include "app/cli/progress_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/base/message.h"
#include "app/cli/interrupt.h"
#include "app/cli/output.h"

namespace trisect {

std::string duration_text(double seconds) {
  const auto whole = static_cast<uint64_t>(std::lround(std::max(seconds, 0.0)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

ProgressLine::ProgressLine(const std::string& step, uint64_t total)
    : step_(message_line(step)), total_(static_cast<double>(total)) {}

ProgressLine::~ProgressLine() {
  if (next_ > 1.0) std::fputs("\r\033[K", stderr);
}

bool ProgressLine::show(double done) {
  if (!not_interrupted()) return false;
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (seconds < next_ || !shows_progress()) return true;
  next_ = seconds + 0.1;
  const double part = total_ > 0.0 ? done / total_ : 1.0;
  constexpr int width = 30;
  const auto filled = static_cast<std::size_t>(part * width);
  const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
  const std::string left =
      part > 0.0 ? fmt::format(", {} left", duration_text(seconds * (1.0 - part) / part)) : "";
  std::fputs(fmt::format("\r{} [{}] {:3.0f}%{}\033[K", step_, bar, part * 100.0, left).c_str(),
             stderr);
  std::fflush(stderr);
  return true;
}

BusyLine::BusyLine(const std::string& step) : step_(message_line(step)) {
  if (shows_progress()) thread_ = std::thread([this] { show_until_ended(); });
}

BusyLine::~BusyLine() {
  if (!thread_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
  }
  end_.notify_one();
  thread_.join();
}

void BusyLine::show_until_ended() {
  std::unique_lock lock(mutex_);
  int seconds = 0;
  while (!end_.wait_for(lock, std::chrono::seconds(1), [this] { return ended_; })) {
    ++seconds;
    std::fputs(fmt::format("\r{} ({} s)", step_, seconds).c_str(), stderr);
    std::fflush(stderr);
  }
  if (seconds > 0) std::fputs("\r\033[K", stderr);
}

}  // namespace trisect
