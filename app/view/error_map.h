// The error of a frame against the oracle, measured beside the window.
#pragma once

#include <atomic>
#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/bake/bake.h"
#include "app/frame/frame.h"

namespace trisect::view {

struct ErrorMap {
  uint32_t width = 0;
  uint32_t height = 0;
  // x: how far off the surface, over the scene's radius, or ERROR_NOTHING and its like.
  std::vector<vec4> errors;
  std::string summary;  // in a line
};

class ErrorMeasurement {
 public:
  ErrorMeasurement() = default;
  // Gives up what is not done.
  ~ErrorMeasurement() { stop(); }
  ErrorMeasurement(const ErrorMeasurement&) = delete;
  ErrorMeasurement& operator=(const ErrorMeasurement&) = delete;
  ErrorMeasurement(ErrorMeasurement&&) = delete;
  ErrorMeasurement& operator=(ErrorMeasurement&&) = delete;

  // frame: with AOVs, of these parameters, robust or bisect.
  void start(std::shared_ptr<const BakedScene> scene, const TraceParams& params, Frame frame);
  void stop();

  // From 0 to 1 while it measures.
  [[nodiscard]] std::optional<float> progress() const;

  // What start() asked for, once.
  std::optional<ErrorMap> poll();

 private:
  std::atomic<bool> stopped_{false};
  std::atomic<uint32_t> rows_done_{0};
  uint32_t rows_ = 1;
  std::future<std::optional<ErrorMap>> running_;
};

}  // namespace trisect::view
