// Decides which frame is traced next, and whether the window has to be drawn again.
#pragma once

#include <cstdint>
#include <optional>

#include "app/view/clock.h"
#include "app/view/frame_content.h"
#include "app/view/pacer.h"

namespace trisect::view {

// While the content of the window changes, every frame is traced at a resolution that keeps to the
// time of a frame. Once the content stays the same, the frame is refined: first to the resolution
// of the window, then to several samples per pixel. After that nothing is traced.
//
// The caller asks plan() what to trace, calls begin(), traces, and reports how that ended by one of
// moving_frame_done(), refinement_done(), refinement_stopped(), failed() and postponed(). A content
// whose frame failed is not tried again until the content changes.
//
// No function waits or reads a clock. Not thread safe.
class FrameScheduler {
 public:
  // Seconds without a change after which a frame is refined.
  static constexpr double kStill = 0.15;

  // Frames that have to be drawn after an event. Dear ImGui takes some frames to lay out its
  // windows anew; a traced frame is followed by one whose panel tells about it.
  static constexpr int kDrawsForPanel = 3;
  static constexpr int kDrawsForTracedFrame = 2;
  static constexpr int kDrawsForProgress = 1;

  enum class Step {
    nothing,
    moving,  // the content is new: trace it at `scale`
    refine,  // the content has stayed: trace it with `samples_across`
  };

  struct Plan {
    Step step = Step::nothing;
    double scale = 1.0;           // of a moving frame: its sides over those of the window
    uint32_t samples_across = 1;  // of a refined frame: samples in a row of a pixel
  };

  // What to trace now. samples_at_rest: samples in a row of a pixel of the finest frame; 0 if not
  // even one sample per pixel fits into the device's memory. frame_ms: time that a moving frame may
  // take, in milliseconds.
  [[nodiscard]] Plan plan(const FrameContent& wanted, uint32_t samples_at_rest, double frame_ms,
                          Clock::time_point now) const;

  // Tracing of that plan begins. Until it is reported as done or stopped it counts as failed.
  void begin(const Plan& plan, const FrameContent& wanted);

  // is_full: the frame has the resolution of the window.
  void moving_frame_done(const FrameContent& content, bool is_full, Clock::time_point now);
  void refinement_done(uint32_t samples_across);
  // Input came while a frame was refined; it will be tried again. frame_is_left: there is still a
  // frame to show. Without one the content has to be traced anew.
  void refinement_stopped(bool frame_is_left);
  void failed(bool frame_is_left);
  // What the frame needs is not there yet; it will be tried again.
  void postponed() { failed_.reset(); }

  // Time that a moving frame of this scale took to trace and for everything else, in milliseconds.
  void record_cost(double scale, double trace_ms, double other_ms) {
    pacer_.record(scale, trace_ms, other_ms);
  }

  // Whether a frame of some content has been traced and is still good.
  [[nodiscard]] bool has_frame() const { return traced_.has_value(); }

  // Whether nothing is left to refine in the frame that was traced last.
  [[nodiscard]] bool is_refined(uint32_t samples_at_rest) const {
    return samples_across_ == samples_at_rest;
  }

  // Seconds until the frame may be refined, possibly negative; nothing if it will not be.
  [[nodiscard]] std::optional<double> seconds_until_refinement(uint32_t samples_at_rest,
                                                               Clock::time_point now) const;

  // Has at least so many frames drawn from now on, traced anew or not.
  void request_draws(int frames);
  [[nodiscard]] bool needs_draw() const { return draws_left_ > 0; }
  void frame_drawn();

 private:
  Pacer pacer_;
  std::optional<FrameContent> traced_;  // what the last frame shows
  std::optional<FrameContent> failed_;  // what could not be traced, or is being traced
  // In a row of a pixel of the window, of the last frame; 0: it has fewer pixels than the window.
  uint32_t samples_across_ = 0;
  Clock::time_point changed_;  // when the last moving frame was done
  int draws_left_ = kDrawsForPanel;
};

}  // namespace trisect::view
