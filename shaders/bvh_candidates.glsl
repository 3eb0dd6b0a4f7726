// Candidates of a ray: the subpatches whose bounding boxes it meets, found by the scene's BVH. The items of its traversal
// are entries of the BVH.

bool no_candidates_left(PixelRay ray, uint item) { return item == BVH_END; }

uint next_item(uint item) { return bvh[item].next; }

// The length by which boxes are enlarged for a ray: several rounding errors of its points.
float slack_of(PixelRay ray) { return BVH_SLACK * ray.frame.stretch * length3(ray.anchor); }

// 1 / a, but finite: an infinity times a distance of 0 from a slab would be a NaN.
vec3 inverse_of(vec3 a) {
  vec3 least = vec3(1e-18);
  return vec3(1.0) / mix(a, least, lessThan(abs(a), least));
}

// The next candidate, which is that of traversal.item on return; NO_TRIANGLE if there is none, or if no steps are left.
// Boxes are tested by slabs (Kay & Kajiya 1986, "Ray tracing complex scenes").
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
