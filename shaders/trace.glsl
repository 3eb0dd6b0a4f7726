// Traversal of the scene by one ray, and the ray's outputs. The candidates come from every_candidate.glsl,
// tile_candidates.glsl or bvh_candidates.glsl, of which one is included ahead. Reads params, triangles and subpatches;
// SURFACE, SHELL, SOLVER, AOVS, COUNTS, DIVIDED, MAY_BE_NONSMOOTH and SHADOWS are constants.

Shape scene_shape() {
  Shape shape;
  shape.surface = SURFACE;
  shape.shell = SHELL;
  shape.alpha = params.alpha;
  return shape;
}

// Iterations of all loops of traverse_bisect in one pass: fewer than the 65535 that llvmpipe allows.
const uint BISECT_STEPS = 65000u;

// Bytes of the three corners of a triangle.
const uint CORNERS_BYTES = 48u;

// A traversal at its beginning. steps: until the ray pauses.
Traversal begin_traversal(int steps) {
  Traversal traversal;
  traversal.hit.z = NO_HIT_YET;
  traversal.hit.weights = vec3(0.0);
  traversal.hit.triangle = NO_TRIANGLE;
  traversal.hit.subpatch = NO_TRIANGLE;
  traversal.counts.evaluations = 0u;
  traversal.counts.candidates = 0u;
  traversal.counts.bytes = 0u;
  traversal.item = 0u;
  traversal.path = WHOLE;
  traversal.steps = steps;
  return traversal;
}

// Ends the traversal of a shadow ray at its first hit, whichever it is.
void end_in_shadow(INOUT(Traversal) traversal) {
  if (!SHADOWS || traversal.hit.triangle == NO_TRIANGLE) return;
  traversal.hit.z = TRAVERSAL_ENDED;
  traversal.path = WHOLE;
}

bool is_finished(PixelRay ray, Traversal traversal) {
  if (SHADOWS && traversal.hit.z == TRAVERSAL_ENDED) return true;
  return SOLVER == SOLVER_ROBUST ? no_candidates_left(ray, traversal.item) : traversal.item >= params.triangle_count;
}

// The thesis's loop over all triangles. hit.z is the distance from the near point. All rays take the same triangles at the
// same time, because drivers load what is the same for all invocations faster: in each pass, as many triangles as the
// iterations of a pass allow.
void traverse_bisect(PixelRay ray, uint pass, INOUT(Traversal) traversal) {
  uint triangles_per_pass = BISECT_STEPS / (params.rank + 4u);
  uint end = min((pass + 1u) * triangles_per_pass, params.triangle_count);
  for (uint t = pass * triangles_per_pass; t < end; ++t) {
    real cdepth = min(traversal.hit.z, ray.far_depth);
    real depth;
    vec3 weights;
    if (COUNTS) traversal.counts.bytes += SURFACE == SURFACE_FLAT ? CORNERS_BYTES : BALL_BYTES;
    if (SURFACE == SURFACE_FLAT) {
      if (!hit_flat(triangles[t], ray.near_point, ray.view, cdepth, depth, weights)) continue;
    } else {
      vec4 domain = triangles[t].Domain;
      if (domain.w < real(0.0)) continue;
      vec2 bounds = rsi(ray.near_point - vec3(domain), ray.view, domain.w);
      if (!chord_ahead(bounds)) continue;
      if (COUNTS) {
        ++traversal.counts.candidates;
        traversal.counts.evaluations += params.rank - 1u;
        traversal.counts.bytes += TRIANGLE_BYTES - BALL_BYTES;
      }
      if (!bisect(scene_shape(), triangles[t], bounds, ray.near_point, ray.view, int(params.rank),
                  params.resolution, params.min_delta, cdepth, depth, weights))
        continue;
    }
    traversal.hit.z = depth;
    traversal.hit.weights = weights;
    traversal.hit.triangle = t;
  }
  traversal.item = end;
}

// Intersects the ray with its candidates, until none or no steps are left. hit.z is in the ray's frame.
void traverse_robust(PixelRay ray, INOUT(Traversal) traversal) {
  while (!is_finished(ray, traversal) && traversal.steps > 0) {
    // find_candidate skips what the ray misses in a loop of its own. In one loop together with the intersection, each
    // subpatch that this ray misses would cost the time of an intersection, masked out, whenever another ray of the
    // subgroup executes one.
    uint subpatch = find_candidate(ray, traversal);
    if (subpatch != NO_TRIANGLE) {
      if (COUNTS && traversal.path == WHOLE) ++traversal.counts.candidates;
      if (COUNTS) traversal.counts.bytes += TRIANGLE_BYTES + SUBPATCH_BYTES;
      intersect_subpatch(scene_shape(), MAY_BE_NONSMOOTH, triangles[subpatches[subpatch].triangle], subpatches[subpatch],
                         subpatch, ray.frame, ray.view, ray.nearest, traversal);
      end_in_shadow(traversal);
      if (traversal.path == WHOLE) traversal.item = next_item(traversal.item);
    }
    traversal.steps -= VISIT_STEPS;
  }
}

// Continues the traversal until it is finished or the steps of a pass are used up. pass: how many passes were before.
void resume(PixelRay ray, uint pass, INOUT(Traversal) traversal) {
  if (SOLVER == SOLVER_ROBUST) {
    traverse_robust(ray, traversal);
  } else {
    traverse_bisect(ray, pass, traversal);
  }
}

// The hit of a finished traversal; its z is the distance from the eye.
Hit hit_of(PixelRay ray, Traversal traversal) {
  Hit hit = traversal.hit;
  hit.z = SOLVER == SOLVER_ROBUST ? ray.axis + (ray.beyond_axis + ray.frame.stretch * hit.z)
                                  : ray.near_distance + hit.z;
  return hit;
}

// The output of a cast ray whose traversal is finished.
CastHit cast_result(PixelRay ray, Traversal traversal) {
  Hit hit = hit_of(ray, traversal);
  bool met = hit.triangle != NO_TRIANGLE;
  CastHit result;
  result.z = met ? hit.z : real(0.0);
  result.u = hit.weights.y;
  result.v = hit.weights.z;
  result.triangle = hit.triangle;
  result.evaluations = traversal.counts.evaluations;
  result.candidates = traversal.counts.candidates;
  result.padding0 = 0u;
  result.padding1 = 0u;
  return result;
}

#include "pixel_color.glsl"

// The outputs of a pixel with this hit, but for the counts of work, which are 0.
void shade_pixel(PixelRay ray, Hit hit, OUT(vec4) color, OUT(PixelAovs) aovs) {
  aovs.normal_z = vec4(0.0);
  aovs.geometric_u = vec4(0.0);
  aovs.v = real(0.0);
  aovs.triangle = hit.triangle;
  aovs.evaluations = 0u;
  aovs.candidates = 0u;
  color = vec4(background(ray.view), 0.0);
  if (hit.triangle == NO_TRIANGLE) return;
  vec3 normal = vertex_normal(triangles[hit.triangle], hit.weights);
  vec3 point = ray.anchor + ray.view * (hit.z - (ray.axis + ray.beyond_axis));
  // Bisection hits front faces only, as in the thesis. The robust solver hits both sides, and lights the one that it hits.
  vec3 lit = SOLVER == SOLVER_ROBUST ? facing(normal, ray.view) : normal;
  color = vec4(surface_color(ray.view, normal, lit, point, hit.z, hit.triangle), 1.0);
  if (AOVS) {
    aovs.normal_z = vec4(normalize3(normal), hit.z);
    aovs.geometric_u =
        vec4(geometric_normal(scene_shape(), triangles[hit.triangle], hit.weights), hit.weights.y);
    aovs.v = hit.weights.z;
  }
}

// The outputs of a pixel whose traversal is finished.
void finish_pixel(PixelRay ray, Traversal traversal, OUT(vec4) color, OUT(PixelAovs) aovs) {
  shade_pixel(ray, hit_of(ray, traversal), color, aovs);
  aovs.evaluations = traversal.counts.evaluations;
  aovs.candidates = traversal.counts.candidates;
}
