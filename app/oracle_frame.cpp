#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "app/oracle.h"

namespace trisect {
namespace {

// Rows of an image, shared among threads.
class RowWorkers {
 public:
  RowWorkers(uint32_t height, std::function<void(uint32_t row)> work)
      : height_(height), work_(std::move(work)) {
    const unsigned count = std::max(1U, std::thread::hardware_concurrency());
    // A thread that cannot be started must not leave the others behind.
    try {
      for (unsigned k = 0; k < count; ++k) threads_.emplace_back([this] { run(); });
    } catch (...) {
      stop();
      throw;
    }
  }
  RowWorkers(const RowWorkers&) = delete;
  RowWorkers& operator=(const RowWorkers&) = delete;
  ~RowWorkers() { stop(); }

  // Returns when all rows are done, or throws what `work` or `progress` threw.
  void wait(const std::function<void(uint32_t)>& progress) {
    constexpr std::chrono::milliseconds period(200);
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, period, [this] { return error_ || done_ == height_; })) {
      const uint32_t done = done_;
      lock.unlock();
      progress(done);
      lock.lock();
    }
    if (error_) std::rethrow_exception(error_);
    lock.unlock();
    progress(height_);
  }

 private:
  void run() {
    for (uint32_t row = next_++; row < height_ && !stopped_; row = next_++) {
      std::exception_ptr error;
      try {
        work_(row);
      } catch (...) {
        error = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      ++done_;
      if (error && !error_) error_ = error;
      if (error) stopped_ = true;
      if (error_ || done_ == height_) changed_.notify_all();
    }
  }

  void stop() {
    stopped_ = true;
    for (std::thread& thread : threads_) {
      if (thread.joinable()) thread.join();
    }
  }

  uint32_t height_;
  std::function<void(uint32_t)> work_;
  std::atomic<uint32_t> next_ = 0;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  uint32_t done_ = 0;  // guarded by mutex_, as is error_
  std::exception_ptr error_;
  std::vector<std::thread> threads_;
};

}  // namespace

OracleFrame oracle_frame(const Oracle& oracle, uint32_t width, uint32_t height,
                         const std::function<OracleRay(uint32_t x, uint32_t y)>& ray_of,
                         const std::function<double(const OracleRay&)>& motion_of,
                         const std::function<void(uint32_t)>& progress) {
  OracleFrame frame{width, height, {}};
  frame.pixels.resize(std::size_t{width} * height);
  RowWorkers workers(height, [&](uint32_t y) {
    for (uint32_t x = 0; x < width; ++x) {
      const OracleRay ray = ray_of(x, y);
      frame.pixels[std::size_t{y} * width + x] = oracle.first(ray, motion_of(ray));
    }
  });
  workers.wait(progress);
  return frame;
}

}  // namespace trisect
