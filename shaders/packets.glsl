// Packets of rays, those of a subgroup, go down the tree over the parts' boxes together.
//
// A packet is tested against a box by interval arithmetic on its rays' origins and directions (Boulos, Wald & Shirley
// 2006, "Geometric and arithmetic culling methods for entire ray packets"), each invocation with a child of its own:
// of eight at least.

const uint CHILDREN = 8u;
const uint SUBPATCH_WORDS = 6u;
const uint TRIANGLE_WORDS = 12u;
// What an invocation loads of a part and its triangle in load_by_all, and where it looks what an entry is.
const uint SHARE_BYTES = 48u;
const uint LINK_BYTES = 4u;
// A packet gives up after so many: llvmpipe ends all loops of a subgroup after 65535 iterations. Its rays then start
// anew one by one.
const int PACKET_STEPS = 16000;

// Bounds of a packet's rays. Axes along which they go backward are mirrored; along those of which that is not sure
// they are `loose`: no slab is met nowhere.
struct Packet {
  vec3 flip;  // 1 or -1
  bvec3 loose;
  vec3 lo;  // of the origins, mirrored, the boxes' slack left out
  vec3 hi;
  vec3 least_inverse;  // of the directions, mirrored
  vec3 most_inverse;
  float begin;
  uint octant;
};

vec3 subgroup_min(vec3 a) { return vec3(subgroupMin(a.x), subgroupMin(a.y), subgroupMin(a.z)); }

vec3 subgroup_max(vec3 a) { return vec3(subgroupMax(a.x), subgroupMax(a.y), subgroupMax(a.z)); }

// Of the rays that are awake.
Packet packet_of(PixelRay ray, bool awake) {
  vec3 least = subgroup_min(ray.view);
  vec3 most = subgroup_max(ray.view);
  vec3 slack = vec3(subgroupMax(slack_of(ray)));
  vec3 lo = subgroup_min(awake ? ray.anchor : vec3(1e30)) - slack;
  vec3 hi = subgroup_max(awake ? ray.anchor : vec3(-1e30)) + slack;
  const vec3 steep = vec3(1e-6);
  bvec3 back = lessThan(most, -steep);
  Packet packet;
  packet.flip = mix(vec3(1.0), vec3(-1.0), back);
  packet.loose = not(bvec3(uvec3(back) | uvec3(greaterThan(least, steep))));
  packet.lo = mix(lo, -hi, back);
  packet.hi = mix(hi, -lo, back);
  packet.least_inverse = vec3(1.0) / mix(most, -least, back);
  packet.most_inverse = vec3(1.0) / mix(least, -most, back);
  packet.begin = subgroupMin(ray.frame.stretch * ray.nearest);
  packet.octant = (back.x ? 1u : 0u) + (back.y ? 2u : 0u) + (back.z ? 4u : 0u);
  return packet;
}

// Whether a ray of the packet may come into the box before `end`.
bool comes_into(Packet packet, vec3 box_lo, vec3 box_hi, float end) {
  bvec3 back = lessThan(packet.flip, vec3(0.0));
  vec3 a = mix(box_lo, -box_hi, back) - packet.hi;
  vec3 b = mix(box_hi, -box_lo, back) - packet.lo;
  vec3 enter = a * mix(packet.most_inverse, packet.least_inverse, greaterThanEqual(a, vec3(0.0)));
  vec3 leave = b * mix(packet.least_inverse, packet.most_inverse, greaterThanEqual(b, vec3(0.0)));
  enter = mix(enter, vec3(-1e30), packet.loose);
  leave = mix(leave, vec3(1e30), packet.loose);
  float first = max(max(enter.x, enter.y), max(enter.z, packet.begin));
  float last = min(min(leave.x, leave.y), min(leave.z, end));
  return first <= last + BVH_SLACK * (abs(first) + abs(last));
}

// The way of a packet down the tree: children of a node that are still to be seen, and those of the nodes above it.
// Children are counted as the packet meets them, front to back: child k stands in entry k ^ octant.
struct Descent {
  uint node;  // its first entry
  uint left;  // bit k: child k
  int level;
  int steps;  // that it may still take
  uint bytes;  // that an invocation has read, of boxes and of what it shares with others of its subgroup
};

// 256 times the number of a node above, and its children that are still to be seen, for each level and subgroup. Not
// an array of the invocation's own: drivers make a ladder of branches of that.
shared uint above[TILE_SIZE * TILE_SIZE / CHILDREN][BVH_LEVELS];

uint children_met(Packet packet, uint node, float end) {
  uint k = gl_SubgroupInvocationID;
  BvhEntry entry = bvh[node + ((k & (CHILDREN - 1u)) ^ packet.octant)];
  bool met = k < CHILDREN && entry.link != BVH_EMPTY &&
             comes_into(packet, vec3(entry.lo_x, entry.lo_y, entry.lo_z), vec3(entry.hi_x, entry.hi_y, entry.hi_z), end);
  return subgroupBallot(met).x;
}

// From the root on.
Descent descent_begun(Packet packet) {
  Descent descent;
  descent.node = 0u;
  descent.left = children_met(packet, 0u, 1e30);
  descent.level = 0;
  descent.steps = PACKET_STEPS;
  descent.bytes = BVH_ENTRY_BYTES;
  return descent;
}

// The next part that a ray of the packet comes near, NO_TRIANGLE if none is left, or no step. z: what the ray has met, in
// its frame. here: whether it is this ray that comes near.
uint next_part(Packet packet, PixelRay ray, float z, inout Descent descent, out bool here) {
  float end = subgroupMax(ray.frame.stretch * z);
  uint subpatch = NO_TRIANGLE;
  here = false;
  bool ended = false;
  do {
    bool up = descent.left == 0u;
    --descent.steps;
    ended = (up && descent.level == 0) || descent.steps <= 0;
    if (up && !ended) {
      --descent.level;
      uint packed = above[gl_SubgroupID][descent.level];
      descent.node = (packed >> CHILDREN) * CHILDREN;
      descent.left = packed & ((1u << CHILDREN) - 1u);
    }
    if (!ended) {
      uint k = uint(findLSB(descent.left));
      descent.left &= descent.left - 1u;
      uint link = bvh[descent.node + (k ^ packet.octant)].link;
      if (link >= BVH_LEAF) {
        if (COUNTS) descent.bytes += LINK_BYTES + BALL_BYTES;
        here = !misses_ball(ray, subpatch_words[(link - BVH_LEAF) * SUBPATCH_WORDS], z);
        // Here and not by the caller: llvmpipe goes through a branch that no ray takes.
        if (subgroupAny(here)) {
          subpatch = link - BVH_LEAF;
          if (COUNTS) descent.bytes += SHARE_BYTES;
        }
      } else {
        if (descent.left != 0u) {
          above[gl_SubgroupID][descent.level] = (descent.node / CHILDREN << CHILDREN) + descent.left;
          ++descent.level;
        }
        descent.node = link;
        descent.left = children_met(packet, link, end);
        if (COUNTS) descent.bytes += LINK_BYTES + BVH_ENTRY_BYTES;
      }
    }
  } while (subpatch == NO_TRIANGLE && !ended);
  descent.steps -= VISIT_STEPS;
  return subpatch;
}

// The part and its triangle, for all invocations of a subgroup: each loads a word, which the others get from it, as
// in trace_tiles.comp.
void load_by_all(uint subpatch, out SubpatchBounds bounds, out Triangle tri) {
  uint lane = gl_SubgroupInvocationID;
  vec4 word = subpatch_words[subpatch * SUBPATCH_WORDS + min(lane, SUBPATCH_WORDS - 1u)];
  bounds.ball = subgroupBroadcast(word, 0);
  bounds.sub_triangle = subgroupBroadcast(word, 1);
  bounds.corner = subgroupBroadcast(word, 2);
  bounds.edge = subgroupBroadcast(word, 3);
  bounds.cone = subgroupBroadcast(word, 4);
  vec4 rest = subgroupBroadcast(word, 5);
  bounds.triangle = floatBitsToUint(rest.x);
  bounds.is_flat = floatBitsToUint(rest.y);
  bounds.gradient_lipschitz = rest.z;
  bounds.skip = 0u;
  uint base = bounds.triangle * TRIANGLE_WORDS;
  word = triangle_words[base + (lane & 7u)];
  tri.Position[0] = subgroupBroadcast(word, 0);
  tri.Position[1] = subgroupBroadcast(word, 1);
  tri.Position[2] = subgroupBroadcast(word, 2);
  tri.Normal[0] = subgroupBroadcast(word, 3);
  tri.Normal[1] = subgroupBroadcast(word, 4);
  tri.Normal[2] = subgroupBroadcast(word, 5);
  tri.TriNormal = subgroupBroadcast(word, 6);
  tri.NormDot = subgroupBroadcast(word, 7);
  word = triangle_words[base + 8u + (lane & 3u)];
  tri.Domain = subgroupBroadcast(word, 0);
  tri.VertexData[0] = subgroupBroadcast(word, 1);
  tri.VertexData[1] = subgroupBroadcast(word, 2);
  tri.VertexData[2] = subgroupBroadcast(word, 3);
}
