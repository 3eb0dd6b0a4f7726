// One part for the rays of a subgroup that come near it, `here`: Newton's method alone. What it leaves open makes a ray
// undecided.
void meet_quickly(Triangle tri, uint triangle, Cage cage, FramedPatch framed, uint part, PixelRay ray, float reach,
                  bool here, inout Walk walk, inout bool undecided) {
  // No step is taken for a ray that passes it by.
  cage.cone.w = here ? cage.cone.w : NO_CONE;
  precise float z;
  precise vec3 weights;
  uint found = meet_once(scene_shape(), tri, cage, framed, ray.view, reach, z, weights, walk.counts.evaluations);
  if (COUNTS && here) ++walk.counts.candidates;
  if (here && found == FOUND_NOTHING) undecided = true;
  if (here && found == FOUND_ROOT) keep_nearest(z, weights, triangle, part, ray.nearest, walk.hit);
}
