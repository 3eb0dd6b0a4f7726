// Kernels for the window's frames, made beside it.
#include "app/view/picture.h"

#include <gtest/gtest.h>

#include <memory>

#include "app/bake/subpatch_bounds.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"

namespace trisect::view {
namespace {

using Use = Picture::Use;

class PictureTest : public test::GpuTest {
 protected:
  [[nodiscard]] std::shared_ptr<const BakedScene> scene_of(const SurfaceChoice& choice) const {
    return std::make_shared<const BakedScene>(bake_with_subpatches(mesh_, choice));
  }

  // Expects the picture to show the scene as a tracer of its own does.
  void expect_shows(const BakedScene& scene) {
    const TraceSettings settings = framed_settings(mesh_, scene, 80, 60);
    ASSERT_TRUE(picture_.trace(settings, {}));
    Frame frame;
    picture_.fetch(frame);
    test::expect_equal(frame, test::trace(scene, settings), "picture");
  }

  // Waits for kernels, as often as it takes.
  Use use_at_last(const std::shared_ptr<const BakedScene>& scene,
                  const std::shared_ptr<const KernelCode>& code) {
    Use use = picture_.use(scene, choice_, code);
    while (use == Use::soon) {
      picture_.wait();
      use = picture_.use(scene, choice_, code);
    }
    return use;
  }

  const Mesh mesh_ = test::load_asset("sphere-20");
  const KernelChoice choice_{SOLVER_ROBUST, true, true};
  Picture picture_{test::validated_device()};
};

TEST_F(PictureTest, WaitsForKernelsAndSharesThem) {
  const auto flatter = scene_of({SURFACE_PHONG, 0.5});
  ASSERT_EQ(picture_.use(flatter, choice_, nullptr), Use::soon);
  picture_.wait();
  ASSERT_EQ(picture_.use(flatter, choice_, nullptr), Use::anew);
  EXPECT_EQ(picture_.use(flatter, choice_, nullptr), Use::as_before);
  expect_shows(*flatter);
  const auto rounder = scene_of({SURFACE_PHONG, 0.65});
  ASSERT_EQ(picture_.use(rounder, choice_, nullptr), Use::anew);
  expect_shows(*rounder);
}

TEST_F(PictureTest, StaysAsItWasUntilTheyAreThere) {
  const auto phong = scene_of({SURFACE_PHONG, 0.65});
  const auto sphere = scene_of({SURFACE_SPHERE});
  ASSERT_EQ(use_at_last(phong, nullptr), Use::anew);
  ASSERT_EQ(picture_.use(sphere, choice_, nullptr), Use::soon);
  expect_shows(*phong);
  // Others are asked for before those are taken: they come after them.
  const auto code = std::make_shared<const KernelCode>();
  EXPECT_EQ(use_at_last(sphere, code), Use::anew);
  expect_shows(*sphere);
}

TEST_F(PictureTest, StaysAsItWasIfTheDeviceRefusesThem) {
  const auto scene = scene_of({SURFACE_PHONG, 0.65});
  ASSERT_EQ(use_at_last(scene, nullptr), Use::anew);
  // An instruction of five words of which one is there.
  const auto broken = std::make_shared<const KernelCode>(
      KernelCode{{"trace_list", {0x07230203U, 0x00010300U, 0U, 8U, 0U, 0x00050011U}}});
  ASSERT_EQ(picture_.use(scene, choice_, broken), Use::soon);
  picture_.wait();
  EXPECT_ANY_THROW(picture_.use(scene, choice_, broken));
  ASSERT_EQ(picture_.use(scene, choice_, nullptr), Use::as_before);
  expect_shows(*scene);
}

}  // namespace
}  // namespace trisect::view
