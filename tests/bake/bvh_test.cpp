// The tree over the subpatches' boxes: complete, conservative, in order.
#include "app/bake/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "app/bake/subpatch_bounds.h"
#include "app/bake/subpatch_boxes.h"
#include "app/surface/to_double.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

constexpr uint32_t kChildren = 8;

BakedScene scene_of(const std::string& asset, const SurfaceChoice& choice) {
  return bake_with_subpatches(test::load_asset(asset), choice);
}

glm::vec3 lo_of(const BvhEntry& e) {
  return {e.lo_x, e.lo_y, e.lo_z};
}
glm::vec3 hi_of(const BvhEntry& e) {
  return {e.hi_x, e.hi_y, e.hi_z};
}

bool contains(const BvhEntry& e, const glm::vec3& lo, const glm::vec3& hi) {
  return glm::all(glm::lessThanEqual(lo_of(e), lo)) &&
         glm::all(glm::greaterThanEqual(hi_of(e), hi));
}

// The leaves of the tree in the order in which a ray that meets every box comes to them. Expects
// that every entry's box contains those below it.
std::vector<uint32_t> subpatches_below(const std::vector<BvhEntry>& bvh, const BakedScene& scene) {
  const std::vector<SubpatchBox> boxes = subpatch_boxes(scene);
  std::vector<uint32_t> leaves;
  std::size_t visited = 0;
  for (uint32_t item = 0; item != BVH_END && visited <= bvh.size(); ++visited) {
    const BvhEntry& entry = bvh.at(item);
    if (entry.link >= BVH_LEAF) {
      const uint32_t leaf = entry.link - BVH_LEAF;
      EXPECT_TRUE(contains(entry, boxes.at(leaf).lo, boxes.at(leaf).hi)) << leaf;
      leaves.push_back(leaf);
      item = entry.next;
    } else if (entry.link == BVH_EMPTY) {
      item = entry.next;
    } else {
      for (uint32_t k = 0; k < kChildren; ++k) {
        const BvhEntry& child = bvh.at(entry.link + k);
        if (child.link == BVH_EMPTY) continue;
        EXPECT_TRUE(contains(entry, lo_of(child), hi_of(child)));
      }
      item = entry.link;
    }
  }
  EXPECT_EQ(visited, bvh.size());
  return leaves;
}

void expect_all_subpatches_once(const std::vector<BvhEntry>& bvh, const BakedScene& scene) {
  std::vector<uint32_t> leaves = subpatches_below(bvh, scene);
  std::sort(leaves.begin(), leaves.end());
  std::vector<uint32_t> expected;
  for (uint32_t i = 0; i < scene.subpatches.size(); ++i) {
    if (scene.subpatches[i].skip == 0) expected.push_back(i);
  }
  EXPECT_EQ(leaves, expected);
}

TEST(Bvh, HoldsEverySubpatchOnce) {
  for (const std::string& name : test::asset_names()) {
    const BakedScene scene = scene_of(name, {SURFACE_PHONG, 0.65, SHELL_NORMAL});
    SCOPED_TRACE(name);
    expect_all_subpatches_once(build_bvh(scene), scene);
  }
}

TEST(Bvh, HoldsOnePatch) {
  BakedScene scene = scene_of("sphere-20", {SURFACE_FLAT, 0.0, SHELL_NORMAL});
  scene.subpatches.resize(1);
  const std::vector<BvhEntry> bvh = build_bvh(scene);
  EXPECT_EQ(bvh.size(), kChildren);
  expect_all_subpatches_once(bvh, scene);
}

TEST(Bvh, HoldsPatchesThatLieInOnePlace) {
  BakedScene scene = scene_of("sphere-20", {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  std::fill(scene.triangles.begin(), scene.triangles.end(), scene.triangles[0]);
  scene.subpatches = bake_subpatches(scene);
  expect_all_subpatches_once(build_bvh(scene), scene);
}

// A tree can be refitted to another surface that divides the patches in the same way, as these all
// do with the cube's.
TEST(Bvh, IsRefittedToAnotherSurface) {
  BakedScene first = scene_of("cube", {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  first.bvh = build_bvh(first);
  for (const SurfaceChoice& choice : {SurfaceChoice{SURFACE_PHONG, 0.6, SHELL_NORMAL},
                                      SurfaceChoice{SURFACE_PHONG, 0.65, SHELL_HEIGHT}}) {
    const BakedScene scene = scene_of("cube", choice);
    const auto bvh = refitted_bvh(scene, first);
    ASSERT_TRUE(bvh.has_value());
    expect_all_subpatches_once(*bvh, scene);
    // The boxes of the root's children together are no larger than in a tree built anew.
    const std::vector<BvhEntry> built = build_bvh(scene);
    const auto all_of = [](const std::vector<BvhEntry>& tree) {
      glm::vec3 lo(1e30F);
      glm::vec3 hi(-1e30F);
      for (uint32_t k = 0; k < kChildren; ++k) {
        if (tree[k].link == BVH_EMPTY) continue;
        lo = glm::min(lo, lo_of(tree[k]));
        hi = glm::max(hi, hi_of(tree[k]));
      }
      return std::pair(lo, hi);
    };
    EXPECT_EQ(all_of(*bvh), all_of(built));
  }
}

TEST(Bvh, IsNotRefittedToOtherSubpatches) {
  BakedScene first = scene_of("teapot", {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  const BakedScene flat = scene_of("teapot", {SURFACE_FLAT, 0.0, SHELL_NORMAL});
  EXPECT_FALSE(refitted_bvh(flat, first).has_value()) << "there is no tree";
  first.bvh = build_bvh(first);
  EXPECT_FALSE(refitted_bvh(flat, first).has_value()) << "flat patches are not divided";
}

TEST(Bvh, BoxesContainTheSurface) {
  for (const SurfaceChoice& choice : {SurfaceChoice{SURFACE_PHONG, 0.65, SHELL_NORMAL},
                                      SurfaceChoice{SURFACE_PHONG, 0.65, SHELL_HEIGHT},
                                      SurfaceChoice{SURFACE_SPHERE, 0.0, SHELL_NORMAL}}) {
    const BakedScene scene = scene_of("saddle", choice);
    const std::vector<SubpatchBox> boxes = subpatch_boxes(scene);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const SubpatchBounds& bounds = scene.subpatches[i];
      if (bounds.skip > 0) continue;
      const in_double::Triangle tri = to_double(scene.triangles[bounds.triangle]);
      constexpr int n = 8;
      for (int a = 0; a <= n; ++a) {
        for (int b = 0; a + b <= n; ++b) {
          const glm::dvec3 l = glm::dvec3(n - a - b, a, b) / static_cast<double>(n);
          const glm::dvec3 w =
              glm::dvec3(glm::vec3(bounds.sub_triangle)) + l * double{bounds.sub_triangle.w};
          const glm::vec3 p(in_double::surface_point(shape_of(choice), tri, w));
          EXPECT_TRUE(glm::all(glm::lessThanEqual(boxes[i].lo, p)) &&
                      glm::all(glm::greaterThanEqual(boxes[i].hi, p)))
              << i;
        }
      }
    }
  }
}

// Along the diagonal of the octants the first child is the nearest and the last one the farthest.
TEST(Bvh, PutsChildrenInTheOrderOfOctants) {
  const BakedScene scene = scene_of("sphere-320", {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  const std::vector<BvhEntry> bvh = build_bvh(scene);
  const auto along = [&](uint32_t k) {
    const glm::vec3 middle = lo_of(bvh[k]) + hi_of(bvh[k]);
    return middle.x + middle.y + middle.z;
  };
  ASSERT_NE(bvh[0].link, BVH_EMPTY);
  ASSERT_NE(bvh[kChildren - 1].link, BVH_EMPTY);
  for (uint32_t k = 1; k + 1 < kChildren; ++k) {
    if (bvh[k].link == BVH_EMPTY) continue;
    EXPECT_LT(along(0), along(k));
    EXPECT_LT(along(k), along(kChildren - 1));
  }
}

}  // namespace
}  // namespace trisect
