#include "app/bake/bvh.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "app/bake/subpatch_boxes.h"
#include "app/base/error.h"

namespace trisect {
namespace {

constexpr uint32_t kChildren = 8;

// The tree as Embree's builder makes it, in its own memory: a leaf is a Node, an inner node a
// Branch.
struct Node {
  uint32_t subpatch = NO_TRIANGLE;  // index; NO_TRIANGLE marks a branch
};
struct Branch : Node {
  std::array<Node*, kChildren> children{};
  std::array<SubpatchBox, kChildren> boxes{};
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

void set_box(BvhEntry& entry, const SubpatchBox& box) {
  entry.lo_x = box.lo.x;
  entry.lo_y = box.lo.y;
  entry.lo_z = box.lo.z;
  entry.hi_x = box.hi.x;
  entry.hi_y = box.hi.y;
  entry.hi_z = box.hi.z;
}

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
std::array<uint32_t, kChildren> octants_of(const Branch& branch) {
  SubpatchBox all = no_box();
  for (uint32_t k = 0; k < kChildren; ++k) {
    if (branch.children[k] != nullptr) all = around(all, branch.boxes[k]);
  }
  std::array<uint32_t, kChildren> at{};
  at.fill(NO_TRIANGLE);
  std::array<bool, kChildren> placed{};
  while (true) {
    float best = -std::numeric_limits<float>::infinity();
    uint32_t best_child = kChildren;
    uint32_t best_octant = kChildren;
    for (uint32_t k = 0; k < kChildren; ++k) {
      if (branch.children[k] == nullptr || placed[k]) continue;
      const glm::vec3 side = (branch.boxes[k].lo - all.lo) + (branch.boxes[k].hi - all.hi);
      for (uint32_t octant = 0; octant < kChildren; ++octant) {
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
    if (best_child == kChildren) return at;
    at[best_octant] = best_child;
    placed[best_child] = true;
  }
}

// Appends the eight entries of a branch and all that is below it. `next`: the entry at which a ray
// goes on after the branch. `level`: of the branch, 0 for the root.
void flatten(const Branch& branch, int level, uint32_t next, std::vector<BvhEntry>& bvh) {
  if (level == BVH_LEVELS || bvh.size() / kChildren == BVH_MOST_NODES) {
    throw InputError("the model has more patches than a tree may hold; use --accel list.");
  }
  const auto first = static_cast<uint32_t>(bvh.size());
  bvh.resize(first + kChildren);
  const std::array<uint32_t, kChildren> children = octants_of(branch);
  for (uint32_t k = kChildren; k-- > 0;) {
    const uint32_t follows = k + 1 < kChildren ? first + k + 1 : next;
    BvhEntry entry{};
    entry.next = follows;
    entry.link = BVH_EMPTY;
    set_box(entry, no_box());
    if (children[k] != NO_TRIANGLE) {
      const Node& child = *branch.children[children[k]];
      set_box(entry, branch.boxes[children[k]]);
      if (child.subpatch != NO_TRIANGLE) {
        entry.link = BVH_LEAF + child.subpatch;
      } else {
        entry.link = static_cast<uint32_t>(bvh.size());
        flatten(static_cast<const Branch&>(child), level + 1, follows, bvh);
      }
    }
    bvh[first + k] = entry;
  }
}

}  // namespace

std::vector<BvhEntry> build_bvh(const BakedScene& scene) {
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
      rtcNewDevice(nullptr));
  const std::unique_ptr<std::remove_pointer_t<RTCBVH>, ReleaseBvh> memory(rtcNewBVH(device.get()));
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.maxBranchingFactor = kChildren;
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

  std::vector<BvhEntry> bvh;
  bvh.reserve(primitives.size() * 3 / 2 + kChildren);
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

std::optional<std::vector<BvhEntry>> refitted_bvh(const BakedScene& scene,
                                                  const BakedScene& other) {
  const bool same_division =
      std::equal(scene.subpatches.begin(), scene.subpatches.end(), other.subpatches.begin(),
                 other.subpatches.end(),
                 [](const SubpatchBounds& a, const SubpatchBounds& b) { return a.skip == b.skip; });
  if (other.bvh.empty() || !same_division) return std::nullopt;
  const std::vector<SubpatchBox> boxes = subpatch_boxes(scene);
  std::vector<BvhEntry> bvh = other.bvh;
  // From the end on, as the entries below an entry come after it.
  for (std::size_t i = bvh.size(); i-- > 0;) {
    BvhEntry& entry = bvh[i];
    if (entry.link == BVH_EMPTY) continue;
    if (entry.link >= BVH_LEAF) {
      set_box(entry, boxes[entry.link - BVH_LEAF]);
      continue;
    }
    SubpatchBox all = no_box();
    for (const BvhEntry& child : std::span(bvh).subspan(entry.link, kChildren)) {
      all =
          around(all, {{child.lo_x, child.lo_y, child.lo_z}, {child.hi_x, child.hi_y, child.hi_z}});
    }
    set_box(entry, all);
  }
  return bvh;
}

}  // namespace trisect
