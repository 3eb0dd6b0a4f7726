// Candidates of a ray: the subpatches whose bounding boxes it meets, found by the scene's BVH front to back. There is no
// stack, so that the item is all that is kept of a traversal which pauses: from a node whose children are done it returns to
// the parent, whose later children are then tested once more, against a hit that may be nearer.

bool no_candidates_left(PixelRay ray, uint item) { return item == BVH_END; }

// The next child of the same node.
uint next_item(uint item) { return item + 1u; }

// The length by which boxes are enlarged for a ray: several rounding errors of its points.
float slack_of(PixelRay ray) { return BVH_SLACK * ray.frame.stretch * length3(ray.anchor); }

// 1 / a, but finite: an infinity times a distance of 0 from a slab would be a NaN.
vec3 inverse_of(vec3 a) {
  vec3 least = vec3(1e-18);
  return vec3(1.0) / mix(a, least, lessThan(abs(a), least));
}

// Place k of a ray that goes back along these axes is child k ^ octant.
uint octant_of(bvec3 back) { return (back.x ? 1u : 0u) + (back.y ? 2u : 0u) + (back.z ? 4u : 0u); }

// The planes of a corner of a child's box along each axis.
vec3 planes_of(uint corner) {
  const uint mask = (1u << BVH_PLANE_BITS) - 1u;
  return vec3(uvec3(corner, corner >> BVH_PLANE_BITS, corner >> (2u * BVH_PLANE_BITS)) & mask);
}

// What a traversal needs of its ray.
struct BoxRay {
  vec3 anchor;
  vec3 inverse;  // 1 / direction
  vec3 slack;    // along the ray, for the slabs of each axis
  uint octant;   // octant_of() the axes on which it goes back
  uint back;     // the bits of a corner's planes along these axes
  float begin;   // least distance along the ray
};

BoxRay box_ray(PixelRay ray) {
  BoxRay boxed;
  boxed.anchor = ray.anchor;
  boxed.inverse = inverse_of(ray.view);
  boxed.slack = slack_of(ray) * abs(boxed.inverse);
  bvec3 back = lessThan(boxed.inverse, vec3(0.0));
  const uint mask = (1u << BVH_PLANE_BITS) - 1u;
  boxed.octant = octant_of(back);
  boxed.back = (back.x ? mask : 0u) | (back.y ? mask << BVH_PLANE_BITS : 0u) |
               (back.z ? mask << (2u * BVH_PLANE_BITS) : 0u);
  boxed.begin = ray.frame.stretch * ray.nearest;
  return boxed;
}

// Where a ray meets the planes of a node's grid: plane q of each axis at q along + enter, or + leave, by which the slab between
// two planes is enlarged.
struct RayInGrid {
  vec3 along;
  vec3 enter;
  vec3 leave;
};

RayInGrid ray_in_grid(BoxRay ray, uint node) {
  vec3 origin = vec3(bvh[node].origin_x, bvh[node].origin_y, bvh[node].origin_z);
  vec3 grid_step = vec3(bvh[node].step_x, bvh[node].step_y, bvh[node].step_z);
  RayInGrid grid;
  grid.along = grid_step * ray.inverse;
  vec3 first = (origin - ray.anchor) * ray.inverse;
  // The bake puts plane q where origin + q grid_step is in single precision, two roundings. Here `first` rounds twice and once
  // more when it is enlarged, `along` and its product with q once each. With the bake's that is four times 2^-24 of either;
  // what else rounds does so relative to the anchor, which ray.slack is for, or to the sum, for which the comparison has room.
  const float roundings = 2.384185791015625e-07;  // 2^-22
  const float last_plane = float((1u << BVH_PLANE_BITS) - 1u);
  vec3 slack = ray.slack + (abs(first) + abs(grid.along) * last_plane) * roundings;
  grid.enter = first - slack;
  grid.leave = first + slack;
  return grid;
}

// Whether the ray may meet the box of a child before the distance `end`; false is certain. Boxes are tested by slabs (Kay &
// Kajiya 1986, "Ray tracing complex scenes").
bool may_meet_child(BoxRay ray, RayInGrid grid, uvec2 box, float end) {
  uint near = (box.x & ~ray.back) | (box.y & ray.back);
  uint far = (box.y & ~ray.back) | (box.x & ray.back);
  vec3 enter = planes_of(near) * grid.along + grid.enter;
  vec3 leave = planes_of(far) * grid.along + grid.leave;
  float first = larger_of(larger_of(enter.x, enter.y), larger_of(enter.z, ray.begin));
  float last = smaller_of(smaller_of(leave.x, leave.y), smaller_of(leave.z, end));
  return first <= last + BVH_SLACK * (abs(first) + abs(last));
}

// Bit k: the ray may meet the node's child at place k before `end`.
uint places_met(BoxRay ray, uint node, float end) {
  RayInGrid grid = ray_in_grid(ray, node);
  uint met = 0u;
  for (uint k = 0u; k < BVH_CHILDREN; ++k) {
    if (may_meet_child(ray, grid, bvh[node].boxes[k], end)) met |= 1u << k;
  }
  met &= bvh[node].children;
  // From children to places: neighbours change places along each axis on which the ray goes back.
  met = (ray.octant & 1u) != 0u ? (met & 0x55u) << 1 | (met >> 1 & 0x55u) : met;
  met = (ray.octant & 2u) != 0u ? (met & 0x33u) << 2 | (met >> 2 & 0x33u) : met;
  return (ray.octant & 4u) != 0u ? (met & 0x0Fu) << 4 | met >> 4 : met;
}

// The next candidate, which is that of traversal.item on return; NO_TRIANGLE if there is none, or if no steps are left.
uint find_candidate(PixelRay ray, INOUT(Traversal) traversal) {
  BoxRay boxed = box_ray(ray);
  float end = ray.frame.stretch * traversal.hit.z;
  uint subpatch = NO_TRIANGLE;
  while (traversal.item != BVH_END && traversal.steps > 0 && subpatch == NO_TRIANGLE) {
    --traversal.steps;
    uint node = traversal.item / BVH_PLACES;
    uint met = places_met(boxed, node, end) & (~0u << (traversal.item % BVH_PLACES));
    if (COUNTS) traversal.counts.bytes += BVH_TEST_BYTES + BVH_LINK_BYTES;
    uint item;
    if (met == 0u) {
      uint parent = bvh[node].parent;
      item = parent == BVH_END ? BVH_END : next_item(parent ^ boxed.octant);
    } else {
      uint place = uint(findLSB(met));
      uint link = bvh[node].links[place ^ boxed.octant];
      bool leaf = link >= BVH_LEAF;
      item = leaf ? node * BVH_PLACES + place : link;
      if (leaf) subpatch = link - BVH_LEAF;
    }
    if (item != traversal.item) traversal.path = WHOLE;
    traversal.item = item;
  }
  return subpatch;
}
