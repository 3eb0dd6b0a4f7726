// Which frame is traced when, by a clock that the tests set.
#include "app/view/frame_scheduler.h"

#include <gtest/gtest.h>

#include <chrono>

namespace trisect::view {
namespace {

using Step = FrameScheduler::Step;

constexpr double kFrameMs = 33.0;

FrameContent content(uint64_t scene) {
  FrameContent content;
  content.scene = scene;
  content.width = 320;
  content.height = 240;
  return content;
}

class FrameSchedulerTest : public ::testing::Test {
 protected:
  void pass(double seconds) {
    now_ += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }

  [[nodiscard]] FrameScheduler::Plan plan(const FrameContent& wanted) const {
    return scheduler_.plan(wanted, samples_at_rest_, kFrameMs, now_);
  }

  void trace_moving(const FrameContent& wanted, bool is_full = false) {
    const FrameScheduler::Plan next = plan(wanted);
    ASSERT_EQ(next.step, Step::moving);
    scheduler_.begin(next, wanted);
    scheduler_.moving_frame_done(wanted, is_full, now_);
  }

  void begin_refinement(const FrameContent& wanted, uint32_t samples_across) {
    const FrameScheduler::Plan next = plan(wanted);
    ASSERT_EQ(next.step, Step::refine);
    ASSERT_EQ(next.samples_across, samples_across);
    scheduler_.begin(next, wanted);
  }

  void refine(const FrameContent& wanted, uint32_t samples_across) {
    begin_refinement(wanted, samples_across);
    scheduler_.refinement_done(samples_across);
  }

  FrameScheduler scheduler_;
  Clock::time_point now_{std::chrono::hours(1)};
  uint32_t samples_at_rest_ = 1;
};

TEST_F(FrameSchedulerTest, TracesTheFirstFrameAtReducedResolution) {
  const FrameScheduler::Plan first = plan(content(1));
  EXPECT_EQ(first.step, Step::moving);
  EXPECT_EQ(first.scale, Pacer().scale(kFrameMs));
  EXPECT_FALSE(scheduler_.has_frame());
  trace_moving(content(1));
  EXPECT_TRUE(scheduler_.has_frame());
  EXPECT_EQ(plan(content(1)).step, Step::nothing);
}

TEST_F(FrameSchedulerTest, TracesEveryChangeAtTheScaleOfThePacer) {
  trace_moving(content(1));
  Pacer pacer;
  for (const double trace_ms : {100.0, 50.0, 20.0}) {
    scheduler_.record_cost(0.5, trace_ms, 3.0);
    pacer.record(0.5, trace_ms, 3.0);
    EXPECT_EQ(plan(content(2)).scale, pacer.scale(kFrameMs));
  }
  trace_moving(content(2));
  trace_moving(content(3));
}

TEST_F(FrameSchedulerTest, RefinesOnceNothingHasChangedForAWhile) {
  trace_moving(content(1));
  EXPECT_NEAR(*scheduler_.seconds_until_refinement(1, now_), 0.15, 1e-6);
  pass(0.14);
  EXPECT_EQ(plan(content(1)).step, Step::nothing);
  // A change begins the wait anew.
  trace_moving(content(2));
  pass(0.14);
  EXPECT_EQ(plan(content(2)).step, Step::nothing);
  EXPECT_NEAR(*scheduler_.seconds_until_refinement(1, now_), 0.01, 1e-6);
  pass(0.02);
  refine(content(2), 1);
  EXPECT_TRUE(scheduler_.is_refined(1));
}

TEST_F(FrameSchedulerTest, GoesFromFullResolutionToSamplesToNothing) {
  samples_at_rest_ = 4;
  trace_moving(content(1));
  pass(0.2);
  refine(content(1), 1);
  EXPECT_FALSE(scheduler_.is_refined(samples_at_rest_));
  // Without another wait.
  refine(content(1), 4);
  EXPECT_TRUE(scheduler_.is_refined(samples_at_rest_));
  pass(100.0);
  EXPECT_EQ(plan(content(1)).step, Step::nothing);
  EXPECT_FALSE(scheduler_.seconds_until_refinement(samples_at_rest_, now_));
  // Fewer samples are another frame, too.
  samples_at_rest_ = 2;
  refine(content(1), 2);
}

TEST_F(FrameSchedulerTest, DoesNotRefineAMovingFrameOfFullResolution) {
  trace_moving(content(1), true);
  pass(1.0);
  EXPECT_EQ(plan(content(1)).step, Step::nothing);
  samples_at_rest_ = 3;
  refine(content(1), 3);
}

TEST_F(FrameSchedulerTest, DoesNotRefineWhatTheDeviceCannotHold) {
  samples_at_rest_ = 0;
  trace_moving(content(1));
  pass(1.0);
  EXPECT_EQ(plan(content(1)).step, Step::nothing);
}

TEST_F(FrameSchedulerTest, TriesAFailedFrameAgainOnlyAfterAChange) {
  scheduler_.begin(plan(content(1)), content(1));
  scheduler_.failed(false);
  EXPECT_FALSE(scheduler_.has_frame());
  pass(10.0);
  EXPECT_EQ(plan(content(1)).step, Step::nothing);
  EXPECT_FALSE(scheduler_.seconds_until_refinement(1, now_));
  trace_moving(content(2));
  // What failed before is tried when it comes again.
  EXPECT_EQ(plan(content(1)).step, Step::moving);
}

TEST_F(FrameSchedulerTest, TriesAFailedRefinementAgainOnlyAfterAChange) {
  trace_moving(content(1));
  pass(0.2);
  begin_refinement(content(1), 1);
  scheduler_.failed(true);
  EXPECT_TRUE(scheduler_.has_frame());
  pass(10.0);
  EXPECT_EQ(plan(content(1)).step, Step::nothing);
  EXPECT_FALSE(scheduler_.seconds_until_refinement(1, now_));
  trace_moving(content(2));
  pass(0.2);
  refine(content(2), 1);
}

TEST_F(FrameSchedulerTest, TriesARefinementAgainThatInputStopped) {
  trace_moving(content(1));
  pass(0.2);
  begin_refinement(content(1), 1);
  scheduler_.refinement_stopped(true);
  EXPECT_TRUE(scheduler_.seconds_until_refinement(1, now_));
  refine(content(1), 1);
}

TEST_F(FrameSchedulerTest, TracesAnewIfAStoppedRefinementLeftNoFrame) {
  trace_moving(content(1));
  pass(0.2);
  begin_refinement(content(1), 1);
  scheduler_.refinement_stopped(false);
  EXPECT_FALSE(scheduler_.has_frame());
  trace_moving(content(1));
  EXPECT_EQ(plan(content(1)).step, Step::nothing);
  pass(0.2);
  refine(content(1), 1);
}

TEST_F(FrameSchedulerTest, CountsTheFramesToDraw) {
  const auto draws_left = [&] {
    int count = 0;
    for (; scheduler_.needs_draw(); ++count) scheduler_.frame_drawn();
    return count;
  };
  EXPECT_EQ(draws_left(), 3);
  scheduler_.frame_drawn();
  EXPECT_EQ(draws_left(), 0);
  // The larger of two requests counts.
  scheduler_.request_draws(2);
  scheduler_.request_draws(1);
  EXPECT_EQ(draws_left(), 2);
  scheduler_.begin(plan(content(1)), content(1));
  scheduler_.failed(false);
  EXPECT_EQ(draws_left(), 3);
}

}  // namespace
}  // namespace trisect::view
