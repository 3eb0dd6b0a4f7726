// Traces the window's frames on the device as the scheduler says.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/base/keep_going.h"
#include "app/view/frame_scheduler.h"
#include "app/view/picture.h"
#include "app/view/screen.h"
#include "app/view/view_state.h"
#include "app/view/window.h"

namespace trisect::view {

// What a frame of changing content was and took.
struct MovingFrame {
  double pixel_part = 1.0;  // its pixels over those of the window
  double trace_ms = 0.0;
  // It was the first one of its kernels: the device also had to get ready for them.
  bool warmed_up = false;
};

// Not thread safe.
class FrameTracer {
 public:
  // All of them must outlive the tracer.
  FrameTracer(const gpu::Device& device, const Window& window, Screen& screen, ViewState& state,
              FrameScheduler& scheduler);

  struct Result {
    // If a frame of changing content was traced.
    std::optional<MovingFrame> moving;
    // A refinement was stopped that had overwritten the frame: there is nothing to draw, and the
    // window should keep what it shows.
    bool frame_was_lost = false;
  };

  // Traces the next frame if one is due. may_refine: asked between two submits of a refinement;
  // false stops it. A frame that cannot be traced becomes a message in the panel, and the window
  // keeps what it can; without any frame that was shown before, DeviceError is thrown instead.
  // Throws DeviceLost always. An interrupt ends every frame.
  Result trace(const KeepGoing& may_refine, bool has_shown_a_frame);

  // Samples in a row of a pixel of the finest frame; 0 if the device's memory does not even hold
  // one sample for each pixel of the window.
  [[nodiscard]] uint32_t samples_at_rest() const;

  // Makes sure that the device takes these kernels for the present scene; waits for them. Throws
  // DeviceError.
  void prepare(const std::shared_ptr<const KernelCode>& code);

  // Whether the last frame that was due has not been traced yet, because the device makes its
  // kernels.
  [[nodiscard]] bool is_waiting() const { return is_waiting_; }

  // The picture with the frame that was traced last, if it still has one.
  [[nodiscard]] const Picture& front() const { return *front_; }

 private:
  // A picture and what traces it.
  struct Target {
    Picture* picture;
    bool is_new;  // scene or kernels are new to it
  };

  // Nothing if the device still makes the kernels.
  std::optional<Target> choose_target(const FrameContent& wanted, double scale);
  std::optional<MovingFrame> trace_moving(const FrameContent& wanted,
                                          const FrameScheduler::Plan& plan);
  bool refine(const FrameContent& wanted, const FrameScheduler::Plan& plan,
              const KeepGoing& may_refine);
  std::optional<double> trace_into(Picture& picture, uint32_t width, uint32_t height,
                                   const KeepGoing& keep_going);
  void count_work();
  void report_failure(const std::string& message);

  const Window& window_;
  Screen& screen_;
  ViewState& state_;
  FrameScheduler& scheduler_;
  Picture still_;   // for frames of at least the window's pixels
  Picture moving_;  // for frames of fewer pixels, where other kernels are faster for those
  Picture* front_ = &still_;
  bool is_waiting_ = false;
};

}  // namespace trisect::view
