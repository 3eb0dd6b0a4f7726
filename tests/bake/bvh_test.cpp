// The tree over the subpatches' boxes: complete, conservative, in order.
#include "app/bake/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/bake/subpatch_bounds.h"
#include "app/bake/subpatch_boxes.h"
#include "app/surface/to_double.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

BakedScene scene_of(const std::string& asset, const SurfaceChoice& choice) {
  return bake_with_subpatches(test::load_asset(asset), choice);
}

bool contains(const SubpatchBox& outer, const SubpatchBox& box) {
  return glm::all(glm::lessThanEqual(outer.lo, box.lo)) &&
         glm::all(glm::greaterThanEqual(outer.hi, box.hi));
}

// Whether the boxes of the leaf, which is child k of node n, and of all above it contain this one.
bool is_contained_in_all(const SubpatchBox& box, const std::vector<BvhNode>& bvh, uint32_t n,
                         uint32_t k) {
  uint32_t item = n * BVH_PLACES + k;
  std::size_t levels = 0;
  while (item != BVH_END && levels <= BVH_LEVELS) {
    const BvhNode& node = bvh.at(item / BVH_PLACES);
    if (!contains(child_box(node, item % BVH_PLACES), box)) return false;
    item = node.parent;
    ++levels;
  }
  return levels <= BVH_LEVELS;
}

// The leaves of the tree. Expects that boxes contain what is below them, that every node knows its
// parent and comes after it, and that there are no other nodes.
std::vector<uint32_t> subpatches_below(const std::vector<BvhNode>& bvh, const BakedScene& scene) {
  const std::vector<SubpatchBox> boxes = subpatch_boxes(scene);
  EXPECT_EQ(bvh.at(0).parent, BVH_END);
  std::vector<uint32_t> leaves;
  std::size_t linked = 1;
  for (uint32_t n = 0; n < bvh.size(); ++n) {
    for (uint32_t k = 0; k < BVH_CHILDREN; ++k) {
      if (!has_child(bvh[n], k)) continue;
      const uint32_t link = bvh[n].links[k];
      if (link >= BVH_LEAF) {
        leaves.push_back(link - BVH_LEAF);
        EXPECT_TRUE(is_contained_in_all(boxes.at(leaves.back()), bvh, n, k)) << leaves.back();
      } else {
        EXPECT_EQ(link % BVH_PLACES, 0U);
        EXPECT_GT(link / BVH_PLACES, n);
        EXPECT_EQ(bvh.at(link / BVH_PLACES).parent, n * BVH_PLACES + k);
        ++linked;
      }
    }
  }
  EXPECT_EQ(linked, bvh.size());
  return leaves;
}

void expect_all_subpatches_once(const std::vector<BvhNode>& bvh, const BakedScene& scene) {
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
  const std::vector<BvhNode> bvh = build_bvh(scene);
  EXPECT_EQ(bvh.size(), 1U);
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
    // The root is no larger than that of a tree built anew.
    const BvhNode built = build_bvh(scene).at(0);
    EXPECT_EQ(bvh->at(0).origin_x, built.origin_x);
    EXPECT_EQ(bvh->at(0).step_x, built.step_x);
    EXPECT_EQ(bvh->at(0).origin_y, built.origin_y);
    EXPECT_EQ(bvh->at(0).step_y, built.step_y);
    EXPECT_EQ(bvh->at(0).origin_z, built.origin_z);
    EXPECT_EQ(bvh->at(0).step_z, built.step_z);
  }
}

// A box on a grid is larger than the box itself by at most a plane's distance on each side.
TEST(Bvh, HasTightBoxes) {
  const BakedScene scene = scene_of("torus", {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  const std::vector<SubpatchBox> boxes = subpatch_boxes(scene);
  for (const BvhNode& node : build_bvh(scene)) {
    const glm::vec3 plane(node.step_x, node.step_y, node.step_z);
    // Beside the rounding of the planes themselves, of numbers up to the torus's size, 1.
    const glm::vec3 most = plane + glm::vec3(1e-6F);
    for (uint32_t k = 0; k < BVH_CHILDREN; ++k) {
      if (!has_child(node, k) || node.links[k] < BVH_LEAF) continue;
      const SubpatchBox& box = boxes.at(node.links[k] - BVH_LEAF);
      const SubpatchBox on_grid = child_box(node, k);
      EXPECT_TRUE(glm::all(glm::lessThanEqual(box.lo - on_grid.lo, most)));
      EXPECT_TRUE(glm::all(glm::lessThanEqual(on_grid.hi - box.hi, most)));
    }
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
  const std::vector<BvhNode> bvh = build_bvh(scene);
  const BvhNode& root = bvh.at(0);
  const auto along = [&](uint32_t k) {
    const SubpatchBox box = child_box(root, k);
    const glm::vec3 middle = box.lo + box.hi;
    return middle.x + middle.y + middle.z;
  };
  ASSERT_TRUE(has_child(root, 0));
  ASSERT_TRUE(has_child(root, BVH_CHILDREN - 1));
  for (uint32_t k = 1; k + 1 < BVH_CHILDREN; ++k) {
    if (!has_child(root, k)) continue;
    EXPECT_LT(along(0), along(k));
    EXPECT_LT(along(k), along(BVH_CHILDREN - 1));
  }
}

}  // namespace
}  // namespace trisect
