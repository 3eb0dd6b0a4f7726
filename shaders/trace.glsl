// One ray's way through the patches, and its outputs. Which patches those are say every_part.glsl, tile_parts.glsl or
// bvh_parts.glsl: one of them is included ahead. Reads params, triangles and cages; SURFACE, SHELL, SOLVER, AOVS, COUNTS,
// GROUPS, KINKS and SHADOWS are constants.

Shape scene_shape() {
  Shape shape;
  shape.surface = SURFACE;
  shape.shell = SHELL;
  shape.alpha = params.alpha;
  return shape;
}

// Iterations of the loops of walk_bisect in one pass.
const uint BISECT_STEPS = 65000u;

// Of the three corners of a triangle.
const uint CORNERS_BYTES = 48u;

// A walk through nothing yet.
Walk walk_begun(int steps) {
  Walk walk;
  walk.hit.z = NOTHING_YET;
  walk.hit.weights = vec3(0.0);
  walk.hit.triangle = NO_TRIANGLE;
  walk.hit.part = NO_TRIANGLE;
  walk.counts.evaluations = 0u;
  walk.counts.candidates = 0u;
  walk.counts.bytes = 0u;
  walk.item = 0u;
  walk.path = WHOLE;
  walk.steps = steps;
  return walk;
}

// Whatever is in the way makes a shadow.
void end_in_shadow(INOUT(Walk) walk) {
  if (!SHADOWS || walk.hit.triangle == NO_TRIANGLE) return;
  walk.hit.z = NOTHING_MORE;
  walk.path = WHOLE;
}

bool is_through(PixelRay ray, Walk walk) {
  if (SHADOWS && walk.hit.z == NOTHING_MORE) return true;
  return SOLVER == SOLVER_ROBUST ? no_parts_left(ray, walk.item) : walk.item >= params.triangle_count;
}

// The thesis's loop. hit.z counts from the near point. All rays take the same triangles at the same time, as many
// in each pass as their loops' iterations allow: drivers load faster what does not differ from ray to ray.
void walk_bisect(PixelRay ray, uint pass, INOUT(Walk) walk) {
  uint share = BISECT_STEPS / (params.rank + 4u);
  uint end = min((pass + 1u) * share, params.triangle_count);
  for (uint t = pass * share; t < end; ++t) {
    real cdepth = min(walk.hit.z, ray.far_depth);
    real depth;
    vec3 weights;
    if (COUNTS) walk.counts.bytes += SURFACE == SURFACE_FLAT ? CORNERS_BYTES : BALL_BYTES;
    if (SURFACE == SURFACE_FLAT) {
      if (!hit_flat(triangles[t], ray.near_point, ray.view, cdepth, depth, weights)) continue;
    } else {
      vec4 domain = triangles[t].Domain;
      vec2 bounds = rsi(ray.near_point - vec3(domain), ray.view, domain.w);
      if (!chord_ahead(bounds)) continue;
      if (COUNTS) {
        ++walk.counts.candidates;
        walk.counts.evaluations += params.rank - 1u;
        walk.counts.bytes += TRIANGLE_BYTES - BALL_BYTES;
      }
      if (!bisect(scene_shape(), triangles[t], bounds, ray.near_point, ray.view, int(params.rank),
                  params.resolution, params.min_delta, cdepth, depth, weights))
        continue;
    }
    walk.hit.z = depth;
    walk.hit.weights = weights;
    walk.hit.triangle = t;
  }
  walk.item = end;
}

// The parts that the ray comes near, until none is left. hit.z is in the ray's frame.
void walk_robust(PixelRay ray, INOUT(Walk) walk) {
  while (!is_through(ray, walk) && walk.steps > 0) {
    // Parts that the ray passes by are passed in a loop of their own: a loop that holds the search below would go
    // through all of it, masked, for each of them.
    uint part = find_part(ray, walk);
    if (part != NO_TRIANGLE) {
      if (COUNTS && walk.path == WHOLE) ++walk.counts.candidates;
      if (COUNTS) walk.counts.bytes += TRIANGLE_BYTES + CAGE_BYTES;
      meet_part(scene_shape(), KINKS, triangles[cages[part].triangle], cages[part], part, ray.frame, ray.view, ray.nearest,
                walk);
      end_in_shadow(walk);
      if (walk.path == WHOLE) walk.item = item_after(walk.item);
    }
    walk.steps -= VISIT_STEPS;
  }
}

// Goes on, for the pass-th time, until the walk is through or the steps of a pass are used.
void go_on(PixelRay ray, uint pass, INOUT(Walk) walk) {
  if (SOLVER == SOLVER_ROBUST) {
    walk_robust(ray, walk);
  } else {
    walk_bisect(ray, pass, walk);
  }
}

// What a walk that is through has met, its z the distance from the eye.
Hit met_by(PixelRay ray, Walk walk) {
  Hit hit = walk.hit;
  hit.z = SOLVER == SOLVER_ROBUST ? ray.axis + (ray.beyond_axis + ray.frame.stretch * hit.z)
                                  : ray.near_distance + hit.z;
  return hit;
}

// The output of a cast ray whose walk is through.
CastHit hit_cast(PixelRay ray, Walk walk) {
  Hit hit = met_by(ray, walk);
  bool met = hit.triangle != NO_TRIANGLE;
  CastHit result;
  result.z = met ? hit.z : real(0.0);
  result.u = hit.weights.y;
  result.v = hit.weights.z;
  result.triangle = hit.triangle;
  result.evaluations = walk.counts.evaluations;
  result.candidates = walk.counts.candidates;
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
void finish_pixel(PixelRay ray, Walk walk, OUT(vec4) color, OUT(PixelAovs) aovs) {
  shade_pixel(ray, met_by(ray, walk), color, aovs);
  aovs.evaluations = walk.counts.evaluations;
  aovs.candidates = walk.counts.candidates;
}
