// Intersects the rays of a subgroup with one subpatch by Newton's method alone. near: whether this invocation's ray is to be
// intersected; the others take part in the control flow only. What Newton's method cannot decide becomes pending.
void intersect_quickly(Triangle tri, uint triangle, SubpatchBounds bounds, FramedPatch framed, uint subpatch,
                       PixelRay ray, float tolerance, bool near, inout Traversal traversal, inout Pending pending) {
  // Without a cone Newton's method takes no step, so that a ray that is not near costs none.
  bounds.cone.w = near ? bounds.cone.w : NO_CONE;
  precise float z;
  precise vec3 weights;
  uint found = intersect_by_newton(scene_shape(), tri, bounds, framed, ray.view, tolerance, z, weights,
                                   traversal.counts.evaluations);
  if (COUNTS && near) ++traversal.counts.candidates;
  add_pending(subpatch, near && found == UNDECIDED, pending);
  if (near && found == FOUND_ROOT) keep_nearest(z, weights, triangle, subpatch, ray.nearest, traversal.hit);
}
