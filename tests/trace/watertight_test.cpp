// No ray passes through a closed model in the normal shell without a hit: a million rays here, a
// hundred million in the slow tests.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/support/gpu.h"
#include "tests/support/scenes.h"
#include "tests/support/watertight.h"

namespace trisect {
namespace {

#ifdef TRISECT_SLOW
constexpr std::size_t kRays = 20'000'000;
#else
constexpr std::size_t kRays = 200'000;
#endif

struct Closed {
  const char* asset;
  uint surface;
  std::size_t rays = kRays;
};

class Watertight : public test::GpuTest, public ::testing::WithParamInterface<Closed> {};

TEST_P(Watertight, HasNoLeak) {
  const Closed& model = GetParam();
  const test::Leaks leaks = test::count_leaks(model.asset, model.surface, model.rays, 11);
  EXPECT_EQ(leaks.rays, model.rays);
  EXPECT_EQ(leaks.leaks, 0U);
  EXPECT_EQ(leaks.nans, 0U);
  // Suspects are rays without a hit near their targets: they graze a silhouette. If
  // they were many, the test would not test anything.
  EXPECT_LT(leaks.suspects, model.rays / 20);
  RecordProperty("suspects", static_cast<int>(leaks.suspects));
}

INSTANTIATE_TEST_SUITE_P(
    Closed, Watertight,
    ::testing::Values(Closed{"sphere-20", SURFACE_PHONG}, Closed{"sphere-20", SURFACE_SPHERE},
                      Closed{"torus", SURFACE_PHONG}, Closed{"capsule", SURFACE_PHONG},
                      Closed{"cube", SURFACE_FLAT}, Closed{"teapot", SURFACE_PHONG},
                      // Fewer rays: of those that graze a silhouette the oracle is asked, which
                      // takes a millisecond there.
                      Closed{"teapot", SURFACE_SPHERE, kRays / 10}),
    [](const ::testing::TestParamInfo<Closed>& closed) {
      std::string name =
          std::string(closed.param.asset) + "_" + std::to_string(closed.param.surface);
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

}  // namespace
}  // namespace trisect
