// Traversal of the scene's BVH by packets of rays: the rays of a subgroup traverse it together.
//
// A packet is tested against a box by interval arithmetic on its rays' origins and directions (Boulos, Wald & Shirley
// 2006, "Geometric and arithmetic culling methods for entire ray packets"). The eight children of a node are tested at
// once, each by one lane of the subgroup, which therefore needs at least eight.

const uint SUBPATCH_WORDS = 6u;
// Bytes that one lane reads in load_uniform, and of a node to test its children.
const uint LANE_SHARE_BYTES = 16u + TRIANGLE_SHARE_BYTES;
const uint NODE_SHARE_BYTES = 24u;
const uint NODE_WORDS = 8u;
// A packet gives up after so many steps, because llvmpipe ends all loops of a subgroup after 65535 iterations. Its rays
// then start over one by one, in trace_bvh.comp.
const int PACKET_STEPS = 16000;

// Bounds of a packet's rays. Axes along which all directions are negative are mirrored, so that the directions are
// positive there. Along an axis where the directions differ in sign or are near zero, the slab test is skipped.
struct Packet {
  vec3 flip;       // component k: -1 if axis k is mirrored, else 1
  bvec3 skip_slab;
  vec3 lo;  // bounds of the rays' anchors on mirrored axes, enlarged by the boxes' slack
  vec3 hi;
  vec3 least_inverse;  // bounds of the reciprocals of the directions on mirrored axes
  vec3 most_inverse;
  float begin;  // the least distance along a ray at which one of them begins
  uint octant;  // octant_of() the mirrored axes
};

vec3 subgroup_min(vec3 a) { return vec3(subgroupMin(a.x), subgroupMin(a.y), subgroupMin(a.z)); }

vec3 subgroup_max(vec3 a) { return vec3(subgroupMax(a.x), subgroupMax(a.y), subgroupMax(a.z)); }

// The packet of the subgroup's rays. Those that are not active leave its bounds of the anchors alone.
Packet packet_of(PixelRay ray, bool is_active) {
  vec3 least = subgroup_min(ray.view);
  vec3 most = subgroup_max(ray.view);
  vec3 slack = vec3(subgroupMax(slack_of(ray)));
  vec3 lo = subgroup_min(is_active ? ray.anchor : vec3(1e30)) - slack;
  vec3 hi = subgroup_max(is_active ? ray.anchor : vec3(-1e30)) + slack;
  const vec3 steep = vec3(1e-6);
  bvec3 back = lessThan(most, -steep);
  Packet packet;
  packet.flip = mix(vec3(1.0), vec3(-1.0), back);
  packet.skip_slab = not(bvec3(uvec3(back) | uvec3(greaterThan(least, steep))));
  packet.lo = mix(lo, -hi, back);
  packet.hi = mix(hi, -lo, back);
  packet.least_inverse = vec3(1.0) / mix(most, -least, back);
  packet.most_inverse = vec3(1.0) / mix(least, -most, back);
  packet.begin = subgroupMin(ray.frame.stretch * ray.nearest);
  packet.octant = octant_of(back);
  return packet;
}

// Whether a ray of the packet may meet the box before the distance `end`; false is certain.
bool may_meet_box(Packet packet, vec3 box_lo, vec3 box_hi, float end) {
  bvec3 back = lessThan(packet.flip, vec3(0.0));
  vec3 a = mix(box_lo, -box_hi, back) - packet.hi;
  vec3 b = mix(box_hi, -box_lo, back) - packet.lo;
  vec3 enter = a * mix(packet.most_inverse, packet.least_inverse, greaterThanEqual(a, vec3(0.0)));
  vec3 leave = b * mix(packet.least_inverse, packet.most_inverse, greaterThanEqual(b, vec3(0.0)));
  enter = mix(enter, vec3(-1e30), packet.skip_slab);
  leave = mix(leave, vec3(1e30), packet.skip_slab);
  float first = larger_of(larger_of(enter.x, enter.y), larger_of(enter.z, packet.begin));
  float last = smaller_of(smaller_of(leave.x, leave.y), smaller_of(leave.z, end));
  return first <= last + BVH_SLACK * (abs(first) + abs(last));
}

// A packet's depth-first traversal of the BVH. Children are visited by their places, in the order in which the packet meets
// them, front to back: at place k is child k ^ octant.
struct PacketTraversal {
  uint node;         // the current node's number
  uint to_visit;     // bit k: the child at place k is met and not yet visited
  int stack_height;  // of subgroup_stacks
  int steps;         // left until the packet gives up
  uint bytes;        // that this invocation has read, its share of what the subgroup loads together
};

// For each subgroup, a stack of the nodes above the current one that have children to visit: the node's number times 256,
// plus its to_visit. In shared memory, because drivers turn a private array with a variable index into a ladder of branches.
// One lane writes what all of them read.
shared uint subgroup_stacks[TILE_SIZE * TILE_SIZE / BVH_CHILDREN][BVH_LEVELS];

// Bit k: the packet may meet the node's child at place k before `end`. Each lane tests one child; one of two lanes loads the
// grid's origin and the other its steps, for the reason given in broadcast.glsl.
uint packet_places_met(Packet packet, uint node, float end) {
  uint lane = gl_SubgroupInvocationID;
  uint child = (lane & (BVH_CHILDREN - 1u)) ^ packet.octant;
  uvec4 loaded = bvh_words[node * NODE_WORDS + (lane & 1u)];
  vec3 origin = uintBitsToFloat(subgroupBroadcast(loaded, 0).xyz);
  uvec4 grid_step = subgroupBroadcast(loaded, 1);
  uvec2 box = bvh[node].boxes[child];
  vec3 lo = origin + planes_of(box.x) * uintBitsToFloat(grid_step.xyz);
  vec3 hi = origin + planes_of(box.y) * uintBitsToFloat(grid_step.xyz);
  bool met = lane < BVH_CHILDREN && (grid_step.w >> child & 1u) != 0u && may_meet_box(packet, lo, hi, end);
  return subgroupBallot(met).x;
}

// At the root.
PacketTraversal begin_packet_traversal(Packet packet) {
  PacketTraversal traversal;
  traversal.node = 0u;
  traversal.to_visit = packet_places_met(packet, 0u, 1e30);
  traversal.stack_height = 0;
  traversal.steps = PACKET_STEPS;
  traversal.bytes = NODE_SHARE_BYTES;
  return traversal;
}

// The next subpatch whose bounding ball a ray of the packet meets before its nearest hit, at depth z in its frame;
// NO_TRIANGLE if there is none, or if no steps are left. near: whether this invocation's ray meets the ball.
uint next_packet_candidate(Packet packet, PixelRay ray, float z, inout PacketTraversal traversal, out bool near) {
  float end = subgroupMax(ray.frame.stretch * z);
  uint subpatch = NO_TRIANGLE;
  near = false;
  bool ended = false;
  do {
    bool up = traversal.to_visit == 0u;
    --traversal.steps;
    ended = (up && traversal.stack_height == 0) || traversal.steps <= 0;
    if (up && !ended) {
      --traversal.stack_height;
      uint top = subgroup_stacks[gl_SubgroupID][traversal.stack_height];
      traversal.node = top >> BVH_CHILDREN;
      traversal.to_visit = top & ((1u << BVH_CHILDREN) - 1u);
    }
    if (!ended) {
      uint k = uint(findLSB(traversal.to_visit));
      traversal.to_visit &= traversal.to_visit - 1u;
      uint link = bvh[traversal.node].links[k ^ packet.octant];
      if (link >= BVH_LEAF) {
        if (COUNTS) traversal.bytes += BVH_LINK_BYTES + BALL_BYTES;
        near = !misses_ball(ray, uintBitsToFloat(subpatch_words[(link - BVH_LEAF) * SUBPATCH_WORDS]), z);
        // Decided in this loop and not by the caller, because llvmpipe executes branches that no invocation takes.
        if (subgroupAny(near)) {
          subpatch = link - BVH_LEAF;
          if (COUNTS) traversal.bytes += LANE_SHARE_BYTES;
        }
      } else {
        if (traversal.to_visit != 0u) {
          if (subgroupElect()) {
            subgroup_stacks[gl_SubgroupID][traversal.stack_height] =
                (traversal.node << BVH_CHILDREN) + traversal.to_visit;
          }
          subgroupMemoryBarrierShared();
          ++traversal.stack_height;
        }
        traversal.node = link / BVH_PLACES;
        traversal.to_visit = packet_places_met(packet, traversal.node, end);
        if (COUNTS) traversal.bytes += BVH_LINK_BYTES + NODE_SHARE_BYTES;
      }
    }
  } while (subpatch == NO_TRIANGLE && !ended);
  traversal.steps -= VISIT_STEPS;
  return subpatch;
}

// The bounds and the triangle of a subpatch that is the same for all invocations of a subgroup, which has eight at least.
// Each lane loads other words and broadcasts them, for the reason given in broadcast.glsl.
void load_uniform(uint subpatch, out SubpatchBounds bounds, out Triangle tri) {
  uint lane = gl_SubgroupInvocationID;
  uvec4 loaded = subpatch_words[subpatch * SUBPATCH_WORDS + min(lane, SUBPATCH_WORDS - 1u)];
  bounds.ball = broadcast_floats(loaded, 0);
  bounds.sub_triangle = broadcast_floats(loaded, 1);
  bounds.corner = broadcast_floats(loaded, 2);
  bounds.edge = broadcast_floats(loaded, 3);
  bounds.cone = broadcast_floats(loaded, 4);
  uvec4 rest = subgroupBroadcast(loaded, 5);
  bounds.triangle = rest.x;
  bounds.is_flat = rest.y;
  bounds.gradient_lipschitz = uintBitsToFloat(rest.z);
  bounds.skip = 0u;
  tri = load_triangle(bounds.triangle);
}
