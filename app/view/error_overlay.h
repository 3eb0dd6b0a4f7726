// The error of a frame, measured in the background and shown in place of its colours.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/view/error_map.h"
#include "app/view/frame_content.h"
#include "vk/buffer.h"
#include "vk/device.h"

namespace trisect::view {

// Has the error of one frame measured at a time, and knows whether that frame is still what the
// window shows. To be used by one thread; the measurement runs in another.
class ErrorOverlay {
 public:
  // Begins to measure and forgets the map of an earlier measurement. content: what the window shows
  // now; frame: the same at a lower resolution, with AOVs, traced by these parameters.
  void start(const FrameContent& content, std::shared_ptr<const BakedScene> scene,
             const TraceParams& params, Frame frame);

  // Part of the measurement that is done, from 0 to 1, while it runs.
  [[nodiscard]] std::optional<float> progress() const { return measurement_.progress(); }

  // Takes over the map when the measurement has ended; returns whether there is a new one. It can
  // be shown after upload().
  bool poll();

  // Copies the map to the device. No frame that reads the last map may be in flight. Throws
  // DeviceError.
  void upload(const gpu::Device& device);

  [[nodiscard]] bool has_map() const { return !map_.errors.empty(); }
  [[nodiscard]] const ErrorMap& map() const { return map_; }

  // Whether there is a map and it is of this content, whatever kernels trace it.
  [[nodiscard]] bool belongs_to(const FrameContent& content) const;

  // The errors on the device, a vec4 for each pixel of the map.
  [[nodiscard]] const gpu::Buffer& errors() const { return *buffer_; }

 private:
  ErrorMeasurement measurement_;
  FrameContent content_;
  ErrorMap map_;
  std::optional<gpu::Buffer> buffer_;
};

}  // namespace trisect::view
