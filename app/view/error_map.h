// The viewer's error map: a frame judged by the oracle on a thread of its own, while the window
// goes on.
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
  // A pixel each, row by row. x: the distance off the surface over the scene's radius where the
  // frame and the oracle both hit, or one of ERROR_NOTHING (both miss), ERROR_UNDECIDED and
  // ERROR_WRONG (only one hits, or the pixel is NaN). A wrong patch or root shows its distance.
  std::vector<vec4> errors;
  std::string summary;  // one line of text
};

// Measures one frame at a time. Its functions are to be called from one thread.
class ErrorMeasurement {
 public:
  ErrorMeasurement() = default;
  // Stops a measurement that runs, as stop() does.
  ~ErrorMeasurement() { stop(); }
  ErrorMeasurement(const ErrorMeasurement&) = delete;
  ErrorMeasurement& operator=(const ErrorMeasurement&) = delete;
  ErrorMeasurement(ErrorMeasurement&&) = delete;
  ErrorMeasurement& operator=(ErrorMeasurement&&) = delete;

  // Begins to measure, after it has stopped what it measured before. frame: with AOVs, rendered of
  // this scene with params.
  void start(std::shared_ptr<const BakedScene> scene, const TraceParams& params, Frame frame);
  // Stops the measurement and waits until it has stopped, which takes as long as a row of pixels.
  // Does nothing if none runs.
  void stop();

  // The share of rows that are done, from 0 to 1; nothing if no measurement runs.
  [[nodiscard]] std::optional<float> progress() const;

  // The map when it is ready, once; nothing before and after that.
  std::optional<ErrorMap> poll();

 private:
  std::atomic<bool> stopped_{false};
  std::atomic<uint32_t> rows_done_{0};
  uint32_t rows_ = 1;
  std::future<std::optional<ErrorMap>> running_;
};

}  // namespace trisect::view
