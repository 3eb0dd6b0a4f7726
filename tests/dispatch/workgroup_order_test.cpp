// The order in which a frame's workgroups run.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "app/surface/shared.h"

namespace trisect {
namespace {

#include "shaders/workgroup_order.glsl"

// Of in_turn() or workgroup_in_turn().
std::vector<uint32_t> order_of(uint32_t count, uint32_t stride, decltype(&in_turn) at) {
  std::vector<uint32_t> order(count);
  for (uint32_t turn = 0; turn < count; ++turn) order[turn] = at(turn, count, stride);
  return order;
}

TEST(WorkgroupOrder, IsRoundsOfOneStride) {
  EXPECT_EQ(order_of(10, 4, in_turn), (std::vector<uint32_t>{0, 4, 8, 1, 5, 9, 2, 6, 3, 7}));
  EXPECT_EQ(order_of(3, 4, in_turn), (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(order_of(4, 1, in_turn), (std::vector<uint32_t>{0, 1, 2, 3}));
}

TEST(WorkgroupOrder, KeepsRunsOfNeighbours) {
  EXPECT_EQ(order_of(20, 2, workgroup_in_turn),
            (std::vector<uint32_t>{0,  1,  2,  3,  4,  5,  6,  7,  8,  9,
                                   10, 11, 12, 13, 14, 15, 16, 17, 18, 19}));
  EXPECT_EQ(order_of(25, 2, workgroup_in_turn),
            (std::vector<uint32_t>{0,  1,  2,  3, 4, 5,  6,  7,  16, 17, 18, 19, 20,
                                   21, 22, 23, 8, 9, 10, 11, 12, 13, 14, 15, 24}));
}

TEST(WorkgroupOrder, HasEveryWorkgroupOnce) {
  for (const uint32_t stride : {1U, 2U, 7U, 64U}) {
    for (uint32_t count = 1; count < 300; ++count) {
      std::vector<int> turns(count);
      for (const uint32_t group : order_of(count, stride, workgroup_in_turn)) {
        ASSERT_LT(group, count);
        ++turns[group];
      }
      ASSERT_EQ(turns, std::vector<int>(count, 1)) << count << " " << stride;
    }
  }
}

// Threads that each take so many turns one after the other all have as much of each part of the
// image.
TEST(WorkgroupOrder, DealsOutEveryPartOfTheImage) {
  constexpr uint32_t count = 7500;  // 800x600
  constexpr uint32_t parts = 10;
  const std::vector<uint32_t> order = order_of(count, 16, workgroup_in_turn);
  for (const uint32_t threads : {2U, 3U, 16U}) {
    const uint32_t share = count / threads;
    for (uint32_t thread = 0; thread < threads; ++thread) {
      std::vector<uint32_t> of_part(parts);
      for (uint32_t i = 0; i < share; ++i) ++of_part[order[thread * share + i] * parts / count];
      // Of each of its rounds, and of what it has of two others, it may have a run more or less.
      const double even = static_cast<double>(share) / parts;
      const double most = (16.0 / threads + 2.0) * WORKGROUP_RUN;
      for (const uint32_t groups : of_part) EXPECT_NEAR(groups, even, most) << threads;
    }
  }
}

}  // namespace
}  // namespace trisect
