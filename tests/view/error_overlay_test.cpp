// Which content a measured error belongs to.
#include "app/view/error_overlay.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "app/bake/subpatch_bounds.h"
#include "app/dispatch/cpu_tracer.h"
#include "app/dispatch/trace_settings.h"
#include "tests/support/scenes.h"

namespace trisect::view {
namespace {

using namespace std::chrono_literals;

FrameContent content() {
  FrameContent content;
  content.scene = 1;
  content.width = 320;
  content.height = 240;
  content.kernels.aovs = false;
  return content;
}

class ErrorOverlayTest : public ::testing::Test {
 protected:
  ErrorOverlayTest() {
    const Mesh mesh = test::load_asset("cube");
    auto scene = std::make_shared<BakedScene>(bake_with_subpatches(mesh, SurfaceChoice{}));
    params_ = make_params(*scene, framed_settings(mesh, *scene, 8, 6));
    trace_on_cpu(*scene, params_, {.aovs = true}, frame_);
    scene_ = std::move(scene);
  }

  void start(const FrameContent& content) { overlay_.start(content, scene_, params_, frame_); }

  // The measurement of 48 pixels ends long before the last of these waits.
  bool wait_for_map() {
    for (int i = 0; i < 6000; ++i) {
      if (overlay_.poll()) return true;
      std::this_thread::sleep_for(10ms);
    }
    return false;
  }

  std::shared_ptr<const BakedScene> scene_;
  TraceParams params_{};
  Frame frame_;
  ErrorOverlay overlay_;
};

TEST_F(ErrorOverlayTest, BelongsToNothingWithoutAMap) {
  EXPECT_FALSE(overlay_.poll());
  EXPECT_FALSE(overlay_.progress());
  EXPECT_FALSE(overlay_.belongs_to(FrameContent{}));
  start(content());
  EXPECT_TRUE(overlay_.progress());
  EXPECT_FALSE(overlay_.has_map());
  EXPECT_FALSE(overlay_.belongs_to(content()));
}

TEST_F(ErrorOverlayTest, BelongsToTheContentThatWasMeasured) {
  start(content());
  ASSERT_TRUE(wait_for_map());
  EXPECT_FALSE(overlay_.progress());
  EXPECT_FALSE(overlay_.poll());
  ASSERT_TRUE(overlay_.has_map());
  EXPECT_EQ(overlay_.map().width, 8U);
  EXPECT_EQ(overlay_.map().height, 6U);
  EXPECT_EQ(overlay_.map().errors.size(), 48U);
  EXPECT_EQ(overlay_.map().summary.substr(0, 5), "8x6: ");
  EXPECT_TRUE(overlay_.belongs_to(content()));
  FrameContent other = content();
  other.scene = 2;
  EXPECT_FALSE(overlay_.belongs_to(other));
  other = content();
  other.code = 1;
  EXPECT_FALSE(overlay_.belongs_to(other));
  other = content();
  other.width = 321;
  EXPECT_FALSE(overlay_.belongs_to(other));
  other = content();
  other.render.eye = glm::dvec3(1.0, 2.0, 3.0);
  EXPECT_FALSE(overlay_.belongs_to(other));
}

// What the window shows beside colour changes its kernels, but not where they hit the surface.
TEST_F(ErrorOverlayTest, BelongsWhateverTheKernels) {
  start(content());
  ASSERT_TRUE(wait_for_map());
  FrameContent other = content();
  other.kernels.aovs = true;
  other.kernels.accel = Accel::bvh;
  EXPECT_TRUE(overlay_.belongs_to(other));
}

TEST_F(ErrorOverlayTest, ForgetsTheMapWhenItMeasuresAgain) {
  start(content());
  ASSERT_TRUE(wait_for_map());
  FrameContent other = content();
  other.scene = 2;
  start(other);
  EXPECT_FALSE(overlay_.has_map());
  EXPECT_FALSE(overlay_.belongs_to(content()));
  ASSERT_TRUE(wait_for_map());
  EXPECT_FALSE(overlay_.belongs_to(content()));
  EXPECT_TRUE(overlay_.belongs_to(other));
}

}  // namespace
}  // namespace trisect::view
