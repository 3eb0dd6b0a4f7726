// One ray's way through the patches, and its outputs. Which patches those are say every_part.glsl, tile_subpatches.glsl or
// bvh_parts.glsl: one of them is included ahead. Reads params, triangles and cages; SURFACE, SHELL, SOLVER, AOVS, COUNTS,
// DIVIDED, MAY_BE_NONSMOOTH and SHADOWS are constants.

Shape scene_shape() {
  Shape shape;
  shape.surface = SURFACE;
  shape.shell = SHELL;
  shape.alpha = params.alpha;
  return shape;
}

// Iterations of the loops of traverse_bisect in one pass.
const uint BISECT_STEPS = 65000u;

// Of the three corners of a triangle.
const uint CORNERS_BYTES = 48u;

// A walk through nothing yet.
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

// Whatever is in the way makes a shadow.
void end_in_shadow(INOUT(Traversal) traversal) {
  if (!SHADOWS || traversal.hit.triangle == NO_TRIANGLE) return;
  traversal.hit.z = TRAVERSAL_ENDED;
  traversal.path = WHOLE;
}

bool is_finished(PixelRay ray, Traversal traversal) {
  if (SHADOWS && traversal.hit.z == TRAVERSAL_ENDED) return true;
  return SOLVER == SOLVER_ROBUST ? no_candidates_left(ray, traversal.item) : traversal.item >= params.triangle_count;
}

// The thesis's loop. hit.z counts from the near point. All rays take the same triangles at the same time, as many
// in each pass as their loops' iterations allow: drivers load faster what does not differ from ray to ray.
void traverse_bisect(PixelRay ray, uint pass, INOUT(Traversal) traversal) {
  uint share = BISECT_STEPS / (params.rank + 4u);
  uint end = min((pass + 1u) * share, params.triangle_count);
  for (uint t = pass * share; t < end; ++t) {
    real cdepth = min(traversal.hit.z, ray.far_depth);
    real depth;
    vec3 weights;
    if (COUNTS) traversal.counts.bytes += SURFACE == SURFACE_FLAT ? CORNERS_BYTES : BALL_BYTES;
    if (SURFACE == SURFACE_FLAT) {
      if (!hit_flat(triangles[t], ray.near_point, ray.view, cdepth, depth, weights)) continue;
    } else {
      vec4 domain = triangles[t].Domain;
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

// The parts that the ray comes near, until none is left. hit.z is in the ray's frame.
void traverse_robust(PixelRay ray, INOUT(Traversal) traversal) {
  while (!is_finished(ray, traversal) && traversal.steps > 0) {
    // Parts that the ray passes by are passed in a loop of their own: a loop that holds the search below would go
    // through all of it, masked, for each of them.
    uint subpatch = find_candidate(ray, traversal);
    if (subpatch != NO_TRIANGLE) {
      if (COUNTS && traversal.path == WHOLE) ++traversal.counts.candidates;
      if (COUNTS) traversal.counts.bytes += TRIANGLE_BYTES + SUBPATCH_BYTES;
      intersect_subpatch(scene_shape(), MAY_BE_NONSMOOTH, triangles[subpatches[subpatch].triangle], subpatches[subpatch], subpatch, ray.frame, ray.view, ray.nearest,
                traversal);
      end_in_shadow(traversal);
      if (traversal.path == WHOLE) traversal.item = next_item(traversal.item);
    }
    traversal.steps -= VISIT_STEPS;
  }
}

// Goes on, for the pass-th time, until the walk is through or the steps of a pass are used.
void resume(PixelRay ray, uint pass, INOUT(Traversal) traversal) {
  if (SOLVER == SOLVER_ROBUST) {
    traverse_robust(ray, traversal);
  } else {
    traverse_bisect(ray, pass, traversal);
  }
}

// What a walk that is through has met, its z the distance from the eye.
Hit hit_of(PixelRay ray, Traversal traversal) {
  Hit hit = traversal.hit;
  hit.z = SOLVER == SOLVER_ROBUST ? ray.axis + (ray.beyond_axis + ray.frame.stretch * hit.z)
                                  : ray.near_distance + hit.z;
  return hit;
}

// The output of a cast ray whose walk is through.
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

// The outputs of a pixel whose ray met this, but for its counts.
void shade_pixel(PixelRay ray, Hit hit, OUT(vec4) color, OUT(PixelAovs) aovs) {
  aovs.normal_z = vec4(0.0);
  aovs.geometric_u = vec4(0.0);
  aovs.v = real(0.0);
  aovs.triangle = hit.triangle;
  aovs.evaluations = 0u;
  aovs.candidates = 0u;
  color = vec4(sky(ray.view), 0.0);
  if (hit.triangle == NO_TRIANGLE) return;
  vec3 normal = vertex_normal(triangles[hit.triangle], hit.weights);
  vec3 point = ray.anchor + ray.view * (hit.z - (ray.axis + ray.beyond_axis));
  // The thesis sees front faces only; the robust solver sees both, and lights the one it sees.
  vec3 lit = SOLVER == SOLVER_ROBUST ? facing(normal, ray.view) : normal;
  color = vec4(shade(lit, point, vec3(params.light), params.grid), 1.0);
  if (AOVS) {
    aovs.normal_z = vec4(normalize3(normal), hit.z);
    aovs.geometric_u =
        vec4(geometric_normal(scene_shape(), triangles[hit.triangle], hit.weights), hit.weights.y);
    aovs.v = hit.weights.z;
  }
}

// The outputs of a pixel whose walk is through.
void finish_pixel(PixelRay ray, Traversal traversal, OUT(vec4) color, OUT(PixelAovs) aovs) {
  shade_pixel(ray, hit_of(ray, traversal), color, aovs);
  aovs.evaluations = traversal.counts.evaluations;
  aovs.candidates = traversal.counts.candidates;
}
