// The parts that a ray goes through: those in whose boxes it comes, found by the tree over them.

bool no_candidates_left(PixelRay ray, uint item) { return item == BVH_END; }

uint next_item(uint item) { return bvh[item].next; }

// By how much the boxes are enlarged for a ray: some roundings of its point.
float slack_of(PixelRay ray) { return BVH_SLACK * ray.frame.stretch * length3(ray.anchor); }

// 1 / a, but for no infinity: that times 0 would be none of a slab's distances.
vec3 inverse_of(vec3 a) {
  vec3 least = vec3(1e-18);
  return vec3(1.0) / mix(a, least, lessThan(abs(a), least));
}

// The next part to be met, at walk.item; NO_TRIANGLE if the tree, or the steps, ended before. Kay & Kajiya's slabs
// (1986).
uint find_candidate(PixelRay ray, INOUT(Traversal) traversal) {
  vec3 inverse = inverse_of(ray.view);
  vec3 slack = vec3(slack_of(ray));
  float begin = ray.frame.stretch * ray.nearest;
  uint subpatch = NO_TRIANGLE;
  while (traversal.item != BVH_END && traversal.steps > 0 && subpatch == NO_TRIANGLE) {
    --traversal.steps;
    BvhEntry entry = bvh[traversal.item];
    if (COUNTS) traversal.counts.bytes += BVH_ENTRY_BYTES;
    vec3 a = (vec3(entry.lo_x, entry.lo_y, entry.lo_z) - slack - ray.anchor) * inverse;
    vec3 b = (vec3(entry.hi_x, entry.hi_y, entry.hi_z) + slack - ray.anchor) * inverse;
    vec3 enter = min(a, b);
    vec3 leave = max(a, b);
    float first = max(max(enter.x, enter.y), max(enter.z, begin));
    float last = min(min(leave.x, leave.y), min(leave.z, ray.frame.stretch * traversal.hit.z));
    if (entry.link == BVH_EMPTY || !(first <= last + BVH_SLACK * (abs(first) + abs(last)))) {
      traversal.item = entry.next;
      traversal.path = WHOLE;
    } else if (entry.link >= BVH_LEAF) {
      subpatch = entry.link - BVH_LEAF;
    } else {
      traversal.item = entry.link;
    }
  }
  return subpatch;
}
