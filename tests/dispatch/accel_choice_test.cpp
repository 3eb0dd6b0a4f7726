// Which acceleration the program takes where the user leaves it open, and what it refuses.
#include <gtest/gtest.h>

#include <string>

#include "app/base/error.h"
#include "app/dispatch/accel.h"

namespace trisect {
namespace {

// The most subpatches for which tiles are taken, of an image of 800x600.
constexpr std::size_t kMost = std::size_t{40} * 100 * 75;

Accel chosen(const AccelRequest& request, std::size_t subpatches) {
  return chosen_accel(request, Backend::vulkan, subpatches);
}

TEST(ChosenAccel, IsTilesOrTheTreeByTheNumberOfSubpatches) {
  EXPECT_EQ(chosen({}, kMost), Accel::tiles);
  EXPECT_EQ(chosen({}, kMost + 1), Accel::bvh);
}

TEST(ChosenAccel, IsTheTreeOnADeviceWithoutSubgroupOperations) {
  EXPECT_EQ(chosen({.subgroups = false}, 1), Accel::bvh);
  EXPECT_EQ(chosen({.subgroups = false}, kMost + 1), Accel::bvh);
  // The user's own choice stays, for the tracer to refuse.
  EXPECT_EQ(chosen({.accel = Accel::tiles, .subgroups = false}, 1), Accel::tiles);
}

// Packets are for subgroups of about as many lanes as a node has children, and for scenes of which
// neighbouring rays meet the same subpatches.
TEST(TracingKernels, GoDownTheTreeInPacketsWhereThatPays) {
  const auto first = [](std::size_t subpatches, uint32_t lanes) {
    return std::string(tracing_kernels(Accel::bvh, subpatches, lanes, false).front());
  };
  for (const uint32_t lanes : {8U, 16U}) {
    EXPECT_EQ(first(150'000, lanes), "trace_packets");
    EXPECT_EQ(first(150'001, lanes), "trace_rays");
  }
  for (const uint32_t lanes : {0U, 4U, 32U, 64U}) EXPECT_EQ(first(1, lanes), "trace_rays");
}

TEST(ChosenAccel, IsTheListForTheBisectionAndOtherBackEnds) {
  EXPECT_EQ(chosen({.solver = SOLVER_BISECT}, 1), Accel::list);
  for (const Backend backend : {Backend::opengl, Backend::cpu, Backend::oracle}) {
    EXPECT_EQ(chosen_accel({}, backend, 1), Accel::list);
    EXPECT_THROW(chosen_accel({.accel = Accel::bvh}, backend, 1), UsageError);
  }
  EXPECT_THROW(chosen({.accel = Accel::tiles, .solver = SOLVER_BISECT}, 1), UsageError);
}

TEST(AccelAtHand, IsTheListUntilTheTreeIsThere) {
  BakedScene scene;
  scene.subpatches.resize(1);
  EXPECT_EQ(accel_at_hand({}, scene), Accel::tiles);
  EXPECT_EQ(accel_at_hand({.subgroups = false}, scene), Accel::list);
  scene.bvh.resize(1);
  EXPECT_EQ(accel_at_hand({.subgroups = false}, scene), Accel::bvh);
}

}  // namespace
}  // namespace trisect
