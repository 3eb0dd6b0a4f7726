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

// The same with a subpatch that is as the bake left it.
void intersect_patch_quickly(Triangle tri, SubpatchBounds bounds, uint subpatch, PixelRay ray, bool near,
                             inout Traversal traversal, inout Pending pending) {
  precise FramedPatch framed = sheared_patch(ray.frame, rotated_patch(ray.frame, SHELL, tri));
  float tolerance = position_tolerance(ray.frame, tri);
  ControlNet net = control_net(framed, bounds.corner.xyz, bounds.edge.xyz,
                               with_overlap(sub_triangle_at(bounds.sub_triangle, WHOLE)));
  near = near && hull_overlaps_ray(net, ray.frame.stretch * bounds.corner.w + tolerance);
  intersect_quickly(tri, bounds.triangle, bounds, framed, subpatch, ray, tolerance, near, traversal, pending);
}
