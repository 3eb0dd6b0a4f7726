// Shadow rays: from the hit of a pixel's camera ray toward the light. Reads params and triangles.

// The geometric normal at the hit, on the side that the camera ray hit.
vec3 visible_normal(PixelAovs hit, vec3 view) { return facing(vec3(hit.geometric_u), view); }

// The shadow ray of a pixel. If its camera ray hit nothing, any ray is good: its traversal ends before it begins.
PixelRay shadow_ray(PixelAovs hit, vec3 view) {
  real u = hit.geometric_u.w;
  vec3 start = vec3(0.0);
  if (hit.triangle != NO_TRIANGLE) {
    start = shadow_ray_origin(scene_shape(), triangles[hit.triangle], vec3(real(1.0) - u - hit.v, u, hit.v),
                      visible_normal(hit, view));
  }
  CastRay ray;
  ray.anchor = vec4(start, 0.0);
  ray.direction = params.light;
  return ray_of_cast(ray);
}

// The shadow ray's traversal. It is ended at once if the camera ray hit nothing, where no shadow can fall, or if the surface
// faces away from the light, which is a shadow without any tracing.
Traversal begin_shadow_traversal(PixelAovs hit, vec3 view, int steps) {
  Traversal traversal = begin_traversal(steps);
  bool lit = hit.triangle != NO_TRIANGLE && dot3(visible_normal(hit, view), vec3(params.light)) > real(0.0);
  if (!lit) {
    traversal.hit.z = TRAVERSAL_ENDED;
    traversal.hit.triangle = hit.triangle;
  }
  return traversal;
}

// The colour of a pixel in shadow; lit pixels keep theirs.
vec4 shadow_color(PixelAovs hit, vec3 view) { return vec4(color_in_shadow(facing(vec3(hit.normal_z), view), hit.triangle), 1.0); }
