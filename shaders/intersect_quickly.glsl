// One part for the rays of a subgroup that come near it, `here`: Newton's method alone. What it leaves open makes a ray
// undecided.
void intersect_quickly(Triangle tri, uint triangle, SubpatchBounds bounds, FramedPatch framed, uint subpatch, PixelRay ray, float tolerance,
                  bool here, inout Traversal traversal, inout bool undecided) {
  // No step is taken for a ray that passes it by.
  bounds.cone.w = here ? bounds.cone.w : NO_CONE;
  precise float z;
  precise vec3 weights;
  uint found = intersect_by_newton(scene_shape(), tri, bounds, framed, ray.view, tolerance, z, weights, traversal.counts.evaluations);
  if (COUNTS && here) ++traversal.counts.candidates;
  if (here && found == UNDECIDED) undecided = true;
  if (here && found == FOUND_ROOT) keep_nearest(z, weights, triangle, subpatch, ray.nearest, traversal.hit);
}
