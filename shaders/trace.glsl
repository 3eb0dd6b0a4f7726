// One pixel: the rays, the list of all triangles, the outputs. Reads params, triangles and cages; SURFACE, SHELL,
// SOLVER, AOVS, COUNTS and GROUPS are constants.

// A pixel's ray. Distances along it count from its near point for the bisection, as in the thesis; the robust solver
// goes by the third coordinate of a frame near the scene's centre.
struct PixelRay {
  vec3 near_point;
  vec3 view;
  real near_distance;  // from the eye
  real far_depth;      // from the near point; the robust solver needs no end
  uint tile;       // of its band
  RayFrame frame;
  real nearest;  // the ray begins there: z in the frame
  vec3 anchor;   // the ray's point at z = 0
  // The anchor's distance from the eye in two parts, of the axis and what the ray has more: added last, they
  // round once.
  real axis;
  real beyond_axis;
};

// The frame of a ray that passes the camera's at depth 0 here.
RayFrame camera_frame(vec2 across) {
  EXACT RayFrame frame;
  frame.anchor = vec3(params.anchor);
  frame.x = vec3(params.frame_x);
  frame.y = vec3(params.frame_y);
  frame.z = vec3(params.frame_z);
  frame.offset = across;
  frame.slope = across / params.anchor.w;
  frame.stretch = sqrt(real(1.0) + frame.slope.x * frame.slope.x + frame.slope.y * frame.slope.y);
  return frame;
}

// The ray through a point of the near plane, given from the eye, that passes the camera's frame at depth 0 here.
PixelRay ray_through(vec3 to_near, vec2 across) {
  PixelRay ray;
  ray.tile = 0u;
  ray.near_distance = length3(to_near);
  ray.far_depth = ray.near_distance * (params.eye.w - real(1.0));
  ray.view = to_near / ray.near_distance;
  ray.near_point = vec3(params.eye) + to_near;
  real axis = params.anchor.w;
  ray.frame = camera_frame(across);
  ray.nearest = params.frame_z.w;
  ray.anchor = ray.frame.anchor + ray.frame.x * across.x + ray.frame.y * across.y;
  real square = across.x * across.x + across.y * across.y;
  ray.axis = axis;
  ray.beyond_axis = square / (axis + sqrt(axis * axis + square));
  return ray;
}

PixelRay pixel_ray(uvec2 pixel) {
  real x = real(pixel.x) + real(0.5);
  real y = real(pixel.y) + real(0.5);
  vec3 to_near = vec3(params.ray_corner) + vec3(params.ray_dx) * x + vec3(params.ray_dy) * y;
  vec2 across = vec2(params.frame_x.w * (x - real(0.5) * real(params.width)),
                     params.frame_y.w * (y - real(0.5) * real(params.height)));
  return ray_through(to_near, across);
}

Shape scene_shape() {
  Shape shape;
  shape.surface = SURFACE;
  shape.shell = SHELL;
  shape.alpha = params.alpha;
  return shape;
}

// Iterations of the loops of walk_bisect in one pass.
const uint BISECT_STEPS = 65000u;

// A walk through nothing yet.
Walk walk_begun(int steps) {
  Walk walk;
  walk.hit.z = real(1e30);
  walk.hit.weights = vec3(0.0);
  walk.hit.triangle = NO_TRIANGLE;
  walk.hit.part = NO_TRIANGLE;
  walk.counts.evaluations = 0u;
  walk.counts.candidates = 0u;
  walk.item = 0u;
  walk.path = WHOLE;
  walk.steps = steps;
  return walk;
}

bool is_through(PixelRay ray, Walk walk) {
  return walk.item >= (SOLVER == SOLVER_ROBUST ? part_count(ray.tile) : params.triangle_count);
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
    if (SURFACE == SURFACE_FLAT) {
      if (!hit_flat(triangles[t], ray.near_point, ray.view, cdepth, depth, weights)) continue;
    } else {
      vec4 domain = triangles[t].Domain;
      vec2 bounds = rsi(ray.near_point - vec3(domain), ray.view, domain.w);
      if (!chord_ahead(bounds)) continue;
      if (COUNTS) {
        ++walk.counts.candidates;
        walk.counts.evaluations += params.rank - 1u;
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

// Every part of every patch whose ball the ray meets; of a divided patch the parts stand in a tree, depth first.
// hit.z is in the ray's frame.
void walk_robust(PixelRay ray, INOUT(Walk) walk) {
  real nearest = ray.frame.stretch * ray.nearest;
  uint count = part_count(ray.tile);
  uint part = 0u;
  while (walk.item < count && walk.steps > 0) {
    // Cages that the ray passes by are passed in a loop of their own: a loop that holds the search below would go
    // through all of it, masked, for each of them.
    bool met = false;
    while (walk.item < count && walk.steps > 0 && !met) {
      --walk.steps;
      part = part_at(ray.tile, walk.item);
      vec4 ball = cages[part].ball;
      vec3 center = vec3(ball) - ray.anchor;
      real z = dot3(center, ray.view);
      real size = dot3(center, center);
      // The distance of the centre from the ray against the radius; the roundings of `size` may add to it.
      bool beside = size - z * z > ball.w * ball.w + real(5e-7) * size || z + ball.w < nearest ||
                    z - ball.w > ray.frame.stretch * walk.hit.z + real(1e-6) * (ball.w + abs(z));
      if (beside) {
        walk.item += GROUPS ? cages[part].skip + 1u : 1u;
        walk.path = WHOLE;
      } else {
        met = !GROUPS || cages[part].skip == 0u;
        if (!met) ++walk.item;
      }
    }
    if (met) {
      if (COUNTS && walk.path == WHOLE) ++walk.counts.candidates;
      meet_part(scene_shape(), triangles[cages[part].triangle], cages[part], part, ray.frame, ray.view, ray.nearest,
                walk);
      if (walk.path == WHOLE) ++walk.item;
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

PixelRay ray_cast(CastRay asked) {
  PixelRay ray;
  ray.tile = 0u;
  ray.near_point = vec3(asked.anchor) + vec3(asked.direction) * asked.anchor.w;
  ray.view = vec3(asked.direction);
  ray.anchor = vec3(asked.anchor);
  ray.frame = ray_frame(ray.anchor, ray.view);
  ray.nearest = asked.anchor.w;
  ray.near_distance = asked.anchor.w;
  ray.far_depth = real(1e30);
  ray.axis = real(0.0);
  ray.beyond_axis = real(0.0);
  return ray;
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
  vec3 lit = SOLVER == SOLVER_ROBUST && dot3(normal, ray.view) > real(0.0) ? -normal : normal;
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
