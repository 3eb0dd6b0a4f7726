#include "app/view/frame_scheduler.h"

#include <algorithm>

namespace trisect::view {

FrameScheduler::Plan FrameScheduler::plan(const FrameContent& wanted, uint32_t samples_at_rest,
                                          double frame_ms, Clock::time_point now) const {
  if (failed_ == wanted) return {};
  if (traced_ != wanted) return {Step::moving, pacer_.scale(frame_ms), 1};
  if (is_refined(samples_at_rest) || seconds_between(changed_, now) < kStill) return {};
  return {Step::refine, 1.0, samples_across_ == 0 ? 1 : samples_at_rest};
}

void FrameScheduler::begin(const Plan& plan, const FrameContent& wanted) {
  failed_ = wanted;
  // A refinement that fails leaves the frame that is there.
  if (plan.step == Step::moving) traced_.reset();
}

void FrameScheduler::moving_frame_done(const FrameContent& content, bool is_full,
                                       Clock::time_point now) {
  traced_ = content;
  failed_.reset();
  samples_across_ = is_full ? 1 : 0;
  changed_ = now;
}

void FrameScheduler::refinement_done(uint32_t samples_across) {
  failed_.reset();
  samples_across_ = samples_across;
}

void FrameScheduler::refinement_stopped(bool frame_is_left) {
  failed_.reset();
  if (!frame_is_left) traced_.reset();
}

void FrameScheduler::failed(bool frame_is_left) {
  request_draws(kDrawsForPanel);
  if (!frame_is_left) traced_.reset();
}

std::optional<double> FrameScheduler::seconds_until_refinement(uint32_t samples_at_rest,
                                                               Clock::time_point now) const {
  if (!traced_ || failed_ || is_refined(samples_at_rest)) return std::nullopt;
  return kStill - seconds_between(changed_, now);
}

void FrameScheduler::request_draws(int frames) {
  draws_left_ = std::max(draws_left_, frames);
}

void FrameScheduler::frame_drawn() {
  draws_left_ = std::max(draws_left_ - 1, 0);
}

}  // namespace trisect::view
