#include "app/bake/bvh.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>

#include "app/base/error.h"
#include "app/base/threads.h"

namespace trisect {
namespace {

// The tree as Embree's builder makes it, in its own memory: a leaf is a Node, an inner node a
// Branch.
struct Node {
  uint32_t subpatch = NO_TRIANGLE;  // index; NO_TRIANGLE marks a branch
};
struct Branch : Node {
  std::array<Node*, BVH_CHILDREN> children{};
  std::array<SubpatchBox, BVH_CHILDREN> boxes{};
};

template <typename T>
T* make(RTCThreadLocalAllocator allocator) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(T), alignof(T))) T;
}

// Embree gets all nodes as pointers to Node, behind void*, and hands them back as such.
Branch& branch_at(void* node) {
  return *static_cast<Branch*>(static_cast<Node*>(node));
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned int, void*) {
  return static_cast<Node*>(make<Branch>(allocator));
}

void set_children(void* node, void** children, unsigned int count, void*) {
  for (unsigned int k = 0; k < count; ++k) {
    branch_at(node).children[k] = static_cast<Node*>(children[k]);
  }
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned int count, void*) {
  for (unsigned int k = 0; k < count; ++k) {
    const RTCBounds& b = *bounds[k];
    branch_at(node).boxes[k] = {{b.lower_x, b.lower_y, b.lower_z},
                                {b.upper_x, b.upper_y, b.upper_z}};
  }
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                  std::size_t, void*) {
  Node* leaf = make<Node>(allocator);
  leaf->subpatch = primitives->primID;
  return leaf;
}

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseBvh {
  void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

SubpatchBox around(const SubpatchBox& a, const SubpatchBox& b) {
  return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)};
}

// The empty box: around() it and a box is that box.
SubpatchBox no_box() {
  const glm::vec3 most(std::numeric_limits<float>::max());
  return {most, -most};
}

// The child for each of the eight octants, NO_TRIANGLE where there is none. Greedy: of the children
// and octants that are left the pair is matched for which the child lies farthest on the octant's
// side.
std::array<uint32_t, BVH_CHILDREN> octants_of(const Branch& branch) {
  SubpatchBox all = no_box();
  for (uint32_t k = 0; k < BVH_CHILDREN; ++k) {
    if (branch.children[k] != nullptr) all = around(all, branch.boxes[k]);
  }
  std::array<uint32_t, BVH_CHILDREN> at{};
  at.fill(NO_TRIANGLE);
  std::array<bool, BVH_CHILDREN> placed{};
  while (true) {
    float best = -std::numeric_limits<float>::infinity();
    uint32_t best_child = BVH_CHILDREN;
    uint32_t best_octant = BVH_CHILDREN;
    for (uint32_t k = 0; k < BVH_CHILDREN; ++k) {
      if (branch.children[k] == nullptr || placed[k]) continue;
      const glm::vec3 side = (branch.boxes[k].lo - all.lo) + (branch.boxes[k].hi - all.hi);
      for (uint32_t octant = 0; octant < BVH_CHILDREN; ++octant) {
        if (at[octant] != NO_TRIANGLE) continue;
        const float far = ((octant & 1U) != 0 ? side.x : -side.x) +
                          ((octant & 2U) != 0 ? side.y : -side.y) +
                          ((octant & 4U) != 0 ? side.z : -side.z);
        if (!(far > best)) continue;
        best = far;
        best_child = k;
        best_octant = octant;
      }
    }
    if (best_child == BVH_CHILDREN) return at;
    at[best_octant] = best_child;
    placed[best_child] = true;
  }
}

// The planes of a node along one axis.
struct Grid {
  float origin;
  float step;

  [[nodiscard]] float plane(uint32_t q) const { return origin + static_cast<float>(q) * step; }
};

constexpr uint32_t kLastPlane = (1U << BVH_PLANE_BITS) - 1U;

// The finest grid from lo to hi. Its step is not denormal, for a device may take that for 0.
Grid grid_over(float lo, float hi) {
  Grid grid{
      lo, std::max((hi - lo) / static_cast<float>(kLastPlane), std::numeric_limits<float>::min())};
  while (grid.plane(kLastPlane) < hi) {
    grid.step = std::nextafter(grid.step, std::numeric_limits<float>::infinity());
  }
  return grid;
}

// The last plane at or below x, which is not below the grid, and the first at or above it.
uint32_t plane_below(const Grid& grid, float x) {
  auto q = static_cast<uint32_t>(
      std::clamp((x - grid.origin) / grid.step, 0.0F, static_cast<float>(kLastPlane)));
  while (q > 0 && grid.plane(q) > x) --q;
  return q;
}
uint32_t plane_above(const Grid& grid, float x) {
  uint32_t q = plane_below(grid, x);
  while (q < kLastPlane && grid.plane(q) < x) ++q;
  return q;
}

// The planes of a corner as BvhNode::boxes has them, and back.
uint corner_of(uint32_t x, uint32_t y, uint32_t z) {
  return x | y << BVH_PLANE_BITS | z << (2U * BVH_PLANE_BITS);
}
vec3 planes_of(uint corner) {
  return {corner & kLastPlane, corner >> BVH_PLANE_BITS & kLastPlane,
          corner >> (2U * BVH_PLANE_BITS) & kLastPlane};
}

// The box around those of a node's children.
SubpatchBox around_children(const BvhNode& node,
                            const std::array<SubpatchBox, BVH_CHILDREN>& boxes) {
  SubpatchBox all = no_box();
  for (uint32_t k = 0; k < BVH_CHILDREN; ++k) {
    if (has_child(node, k)) all = around(all, boxes[k]);
  }
  return all;
}

// Sets the node's grid and the boxes of its children.
void set_boxes(BvhNode& node, const std::array<SubpatchBox, BVH_CHILDREN>& boxes) {
  const SubpatchBox all = around_children(node, boxes);
  const Grid x = grid_over(all.lo.x, all.hi.x);
  const Grid y = grid_over(all.lo.y, all.hi.y);
  const Grid z = grid_over(all.lo.z, all.hi.z);
  node.origin_x = x.origin;
  node.origin_y = y.origin;
  node.origin_z = z.origin;
  node.step_x = x.step;
  node.step_y = y.step;
  node.step_z = z.step;
  for (uint32_t k = 0; k < BVH_CHILDREN; ++k) {
    if (!has_child(node, k)) continue;
    const SubpatchBox& box = boxes[k];
    node.boxes[k] = {
        corner_of(plane_below(x, box.lo.x), plane_below(y, box.lo.y), plane_below(z, box.lo.z)),
        corner_of(plane_above(x, box.hi.x), plane_above(y, box.hi.y), plane_above(z, box.hi.z))};
  }
}

// Appends a branch and all that is below it. parent: as in BvhNode. `level`: of the branch, 0 for
// the root.
void flatten(const Branch& branch, int level, uint32_t parent, std::vector<BvhNode>& bvh) {
  if (level == BVH_LEVELS || bvh.size() == BVH_MOST_NODES) {
    throw InputError("the model has more patches than a tree may hold; use --accel list.");
  }
  const auto number = static_cast<uint32_t>(bvh.size());
  bvh.emplace_back();
  BvhNode node{};
  node.parent = parent;
  const std::array<uint32_t, BVH_CHILDREN> children = octants_of(branch);
  std::array<SubpatchBox, BVH_CHILDREN> boxes{};
  for (uint32_t k = 0; k < BVH_CHILDREN; ++k) {
    if (children[k] == NO_TRIANGLE) continue;
    node.children |= 1U << k;
    boxes[k] = branch.boxes[children[k]];
    const Node& child = *branch.children[children[k]];
    if (child.subpatch != NO_TRIANGLE) {
      node.links[k] = BVH_LEAF + child.subpatch;
    } else {
      node.links[k] = static_cast<uint32_t>(bvh.size()) * BVH_PLACES;
      flatten(static_cast<const Branch&>(child), level + 1, number * BVH_PLACES + k, bvh);
    }
  }
  set_boxes(node, boxes);
  bvh[number] = node;
}

}  // namespace

std::vector<BvhNode> build_bvh(const BakedScene& scene) {
  const std::vector<SubpatchBox> boxes = subpatch_boxes(scene);
  std::vector<RTCBuildPrimitive> primitives;
  primitives.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (scene.subpatches[i].skip > 0) continue;
    const SubpatchBox& b = boxes[i];
    primitives.push_back(
        {b.lo.x, b.lo.y, b.lo.z, 0, b.hi.x, b.hi.y, b.hi.z, static_cast<uint32_t>(i)});
  }

  const std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice> device(
      rtcNewDevice(fmt::format("threads={}", worker_threads()).c_str()));
  const std::unique_ptr<std::remove_pointer_t<RTCBVH>, ReleaseBvh> memory(rtcNewBVH(device.get()));
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.maxBranchingFactor = BVH_CHILDREN;
  arguments.maxDepth = BVH_LEVELS;
  arguments.maxLeafSize = 1;
  arguments.bvh = memory.get();
  arguments.primitives = primitives.data();
  arguments.primitiveCount = primitives.size();
  arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  Node* root = static_cast<Node*>(rtcBuildBVH(&arguments));
  if (root == nullptr) {
    if (rtcGetDeviceError(device.get()) == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error("Embree could not build a tree of " +
                             std::to_string(primitives.size()) + " boxes.");
  }

  std::vector<BvhNode> bvh;
  bvh.reserve(primitives.size() / 4 + 1);
  if (root->subpatch != NO_TRIANGLE) {
    Branch only;
    only.children[0] = root;
    only.boxes[0] = boxes[root->subpatch];
    flatten(only, 0, BVH_END, bvh);
  } else {
    flatten(static_cast<const Branch&>(*root), 0, BVH_END, bvh);
  }
  return bvh;
}

SubpatchBox child_box(const BvhNode& node, uint32_t k) {
  const vec3 origin(node.origin_x, node.origin_y, node.origin_z);
  const vec3 step(node.step_x, node.step_y, node.step_z);
  return {origin + planes_of(node.boxes[k].x) * step, origin + planes_of(node.boxes[k].y) * step};
}

std::optional<std::vector<BvhNode>> refitted_bvh(const BakedScene& scene, const BakedScene& other) {
  const bool same_division =
      std::equal(scene.subpatches.begin(), scene.subpatches.end(), other.subpatches.begin(),
                 other.subpatches.end(),
                 [](const SubpatchBounds& a, const SubpatchBounds& b) { return a.skip == b.skip; });
  if (other.bvh.empty() || !same_division) return std::nullopt;
  const std::vector<SubpatchBox> boxes = subpatch_boxes(scene);
  std::vector<BvhNode> bvh = other.bvh;
  // From the last node on, as those below a node come after it.
  std::vector<SubpatchBox> around_nodes(bvh.size());
  for (std::size_t i = bvh.size(); i-- > 0;) {
    BvhNode& node = bvh[i];
    std::array<SubpatchBox, BVH_CHILDREN> children{};
    for (uint32_t k = 0; k < BVH_CHILDREN; ++k) {
      if (!has_child(node, k)) continue;
      const uint32_t link = node.links[k];
      children[k] = link >= BVH_LEAF ? boxes[link - BVH_LEAF] : around_nodes[link / BVH_PLACES];
    }
    around_nodes[i] = around_children(node, children);
    set_boxes(node, children);
  }
  return bvh;
}

}  // namespace trisect
