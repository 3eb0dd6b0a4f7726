// Shadow rays: from what a pixel's ray has met toward the light. Reads params and triangles.

// The geometric normal of what was met, on the side from which it was seen.
vec3 normal_seen(PixelAovs met, vec3 view) { return facing(vec3(met.geometric_u), view); }

// One of a pixel whose ray has met nothing starts anywhere.
PixelRay shadow_ray(PixelAovs met, vec3 view) {
  real u = met.geometric_u.w;
  vec3 start = vec3(0.0);
  if (met.triangle != NO_TRIANGLE) {
    start = shadow_ray_origin(scene_shape(), triangles[met.triangle], vec3(real(1.0) - u - met.v, u, met.v),
                      normal_seen(met, view));
  }
  CastRay ray;
  ray.anchor = vec4(start, 0.0);
  ray.direction = params.light;
  return ray_of_cast(ray);
}

// Its walk. Where nothing was met, and where the surface itself turns away from the light, it is through before it
// begins.
Traversal begin_shadow_traversal(PixelAovs met, vec3 view, int steps) {
  Traversal traversal = begin_traversal(steps);
  bool lit = met.triangle != NO_TRIANGLE && dot3(normal_seen(met, view), vec3(params.light)) > real(0.0);
  if (!lit) {
    traversal.hit.z = TRAVERSAL_ENDED;
    traversal.hit.triangle = met.triangle;
  }
  return traversal;
}

// What a pixel in shadow shows; others stay as they are.
vec4 shadow_color() { return vec4(vec3(AMBIENT), 1.0); }
