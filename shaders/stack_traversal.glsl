// Traversal of the scene's BVH by one ray with a stack, which spares it the returns to parents of bvh_candidates.glsl. A
// traversal cannot pause: where it takes too long it gives up.

// The nodes above the current one that have children to visit. Bit k of an entry: the child at place k is to be visited; the
// bits from BVH_CHILDREN on are the node's number. Without an array, which drivers would index by branches.
struct NodeStack {
  uvec4 top;  // the last one pushed comes first
  uvec4 below;
  uint height;
};
const uint STACK_ENTRIES = 8u;

void push_node(uint node, uint to_visit, inout NodeStack stack) {
  stack.below = uvec4(stack.top.w, stack.below.xyz);
  stack.top = uvec4(node << BVH_CHILDREN | to_visit, stack.top.xyz);
  ++stack.height;
}

void pop_node(out uint node, out uint to_visit, inout NodeStack stack) {
  node = stack.top.x >> BVH_CHILDREN;
  to_visit = stack.top.x & ((1u << BVH_CHILDREN) - 1u);
  stack.top = uvec4(stack.top.yzw, stack.below.x);
  stack.below = uvec4(stack.below.yzw, 0u);
  --stack.height;
}

struct StackTraversal {
  BoxRay ray;
  uint node;      // the current node's number
  uint to_visit;  // bit k: its child at place k is met and not yet visited
  NodeStack stack;
  bool has_given_up;  // no steps are left, or the stack is too low
};

// At the root. end: the greatest distance along the ray.
StackTraversal begin_stack_traversal(PixelRay ray, float end, inout Traversal traversal) {
  StackTraversal at;
  at.ray = box_ray(ray);
  at.node = 0u;
  at.to_visit = places_met(at.ray, 0u, end);
  if (COUNTS) traversal.counts.bytes += BVH_TEST_BYTES;
  at.stack.top = uvec4(0u);
  at.stack.below = uvec4(0u);
  at.stack.height = 0u;
  at.has_given_up = false;
  return at;
}

// Whether the ray may meet this child of a node before the distance `end`. It is asked where a hit has come nearer since all
// children of the node were tested: every eighth node need not be read then, of a tree over a million patches.
bool is_still_met(BoxRay ray, uint node, uint child, float end, inout Traversal traversal) {
  if (COUNTS) traversal.counts.bytes += BVH_BOX_BYTES;
  return may_meet_child(ray, ray_in_grid(ray, node), bvh[node].boxes[child], end);
}

// The next subpatch whose box the ray meets before the distance `end`; NO_TRIANGLE if there is none. If it has given up there
// may be others.
uint next_candidate(float end, inout StackTraversal at, inout Traversal traversal) {
  uint subpatch = NO_TRIANGLE;
  bool ended = at.has_given_up;
  while (subpatch == NO_TRIANGLE && !ended) {
    if (at.to_visit == 0u) {
      ended = at.stack.height == 0u;
      pop_node(at.node, at.to_visit, at.stack);
    }
    if (!ended) {
      uint child = uint(findLSB(at.to_visit)) ^ at.ray.octant;
      at.to_visit &= at.to_visit - 1u;
      if (traversal.hit.triangle == NO_TRIANGLE || is_still_met(at.ray, at.node, child, end, traversal)) {
        uint link = bvh[at.node].links[child];
        if (COUNTS) traversal.counts.bytes += BVH_LINK_BYTES;
        if (link >= BVH_LEAF) {
          subpatch = link - BVH_LEAF;
        } else {
          if (at.to_visit != 0u) push_node(at.node, at.to_visit, at.stack);
          at.node = link / BVH_PLACES;
          at.to_visit = places_met(at.ray, at.node, end);
          if (COUNTS) traversal.counts.bytes += BVH_TEST_BYTES;
        }
      }
      --traversal.steps;
      at.has_given_up = traversal.steps <= 0 || at.stack.height > STACK_ENTRIES;
      ended = at.has_given_up;
    }
  }
  traversal.steps -= VISIT_STEPS;
  return subpatch;
}
