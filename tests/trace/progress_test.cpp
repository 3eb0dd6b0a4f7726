// What every back end tells while it traces: which part of the work is done.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/dispatch/trace_settings.h"
#include "app/dispatch/vulkan_tracer.h"
#include "app/trace/trace_scene.h"
#include "tests/support/frame_difference.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

constexpr uint32_t kWidth = 160;
constexpr uint32_t kHeight = 120;

class FrameProgress : public test::GpuTest {
 protected:
  FrameProgress()
      : mesh_(test::load_asset("sphere-20")),
        scene_(bake_with_subpatches(mesh_, {SURFACE_PHONG, 0.65, SHELL_NORMAL})),
        settings_(test::framed(mesh_, scene_, kWidth, kHeight, 10)) {
    scene_.bvh = build_bvh(scene_);
    settings_.solver = SOLVER_ROBUST;
    params_ = make_params(scene_, settings_);
  }

  FractionProgress teller() {
    told_.clear();
    return [this](double done) {
      told_.push_back(done);
      return true;
    };
  }

  // Expects the parts to rise to the whole, and at least so many different ones.
  void expect_risen(std::size_t least, const std::string& what) {
    SCOPED_TRACE(what);
    // A part of a part is rounded.
    constexpr double rounding = 1e-12;
    ASSERT_FALSE(told_.empty());
    EXPECT_GE(told_.front(), 0.0);
    for (std::size_t k = 1; k < told_.size(); ++k) EXPECT_GE(told_[k], told_[k - 1] - rounding);
    EXPECT_NEAR(told_.back(), 1.0, rounding);
    EXPECT_GE((std::set<double>(told_.begin(), told_.end())).size(), least);
  }

  Mesh mesh_;
  BakedScene scene_;
  TraceSettings settings_;
  TraceParams params_;
  std::vector<double> told_;
};

TEST_F(FrameProgress, RisesOnEveryBackEnd) {
  struct Case {
    Backend backend;
    GlPath path;
    Accel accel;
    bool shadows;
  };
  // A device's first frame takes several submits, as nothing is known of their cost.
  for (const Case& c : {Case{Backend::vulkan, GlPath::compute, Accel::list, false},
                        Case{Backend::vulkan, GlPath::compute, Accel::list, true},
                        Case{Backend::vulkan, GlPath::compute, Accel::tiles, true},
                        Case{Backend::opengl, GlPath::compute, Accel::list, true},
                        Case{Backend::opengl, GlPath::fragment, Accel::list, false},
                        Case{Backend::cpu, GlPath::compute, Accel::list, false},
                        Case{Backend::oracle, GlPath::compute, Accel::list, true}}) {
    TraceRequest request;
    request.backend = c.backend;
    request.gl_path = c.path;
    const KernelChoice choice{SOLVER_ROBUST, true, false, c.accel, c.shadows};
    const std::string what = std::string(backend_name(c.backend)) + ", " + accel_name(c.accel);
    const auto tracer = make_tracer(request, scene_, kWidth, kHeight, choice);
    Frame frame;
    ASSERT_TRUE(tracer->render(params_, frame, teller()));
    expect_risen(is_device(c.backend) ? 3 : 1, what);
    // Several frames are one piece of work.
    request.runs = 3;
    ASSERT_TRUE(trace_runs(*tracer, request, params_, frame, teller()));
    expect_risen(3, what + ", three runs");
  }
}

TEST_F(FrameProgress, RisesFromBandToBand) {
  // Buffers for 50 of the rows.
  constexpr std::size_t limit = std::size_t{kWidth} * 50 * sizeof(PixelAovs);
  VulkanTracer tracer(test::validated_device(), scene_, kWidth, kHeight,
                      {SOLVER_ROBUST, true, false, Accel::bvh}, limit);
  ASSERT_FALSE(tracer.holds_at_once(kWidth, kHeight));
  Frame frame;
  ASSERT_TRUE(tracer.render(params_, frame, teller()));
  expect_risen(3, "three bands");
}

}  // namespace
}  // namespace trisect
