// Camera rays, and rays that are cast one by one. Reads params.

// A ray with all that the two solvers need of it. Positions are in world units from the scene's origin. Bisection measures
// distances along the ray from its near point, as in the thesis; the robust solver uses z, the third coordinate in a frame
// near the scene's centre.
struct PixelRay {
  vec3 near_point;     // on the near plane
  vec3 view;           // unit direction
  real near_distance;  // of the near point from the eye
  real far_depth;      // distance of the far plane from the near point; the robust solver has no far end
  uint tile;           // of the ray's pixel, counted from the first tile of the band
  RayFrame frame;
  real nearest;  // z at which the ray begins
  vec3 anchor;   // the ray's point at z = 0
  // The anchor's distance from the eye is axis + beyond_axis: the distance along the camera's axis, and what the slanted ray
  // has more. Kept apart, so that a hit's distance is rounded once, when the terms are added.
  real axis;
  real beyond_axis;
};

// The frame of the camera ray whose point at z = 0 has the x and y `across` in the camera's frame.
RayFrame camera_frame(vec2 across) {
  EXACT RayFrame frame;
  frame.anchor = vec3(params.anchor);
  frame.x = vec3(params.frame_x);
  frame.y = vec3(params.frame_y);
  frame.z = vec3(params.frame_z);
  frame.offset = across;
  frame.slope = divide2(across, params.anchor.w);
  frame.stretch = square_root(real(1.0) + frame.slope.x * frame.slope.x + frame.slope.y * frame.slope.y);
  return frame;
}

// The camera ray through a point of the near plane, given relative to the eye. across: as for camera_frame.
PixelRay ray_through(vec3 to_near, vec2 across) {
  PixelRay ray;
  ray.tile = 0u;
  ray.near_distance = square_root(dot3(to_near, to_near));
  ray.far_depth = ray.near_distance * (params.eye.w - real(1.0));
  ray.view = divide3(to_near, ray.near_distance);
  ray.near_point = vec3(params.eye) + to_near;
  real axis = params.anchor.w;
  ray.frame = camera_frame(across);
  ray.nearest = params.frame_z.w;
  ray.anchor = ray.frame.anchor + ray.frame.x * across.x + ray.frame.y * across.y;
  real square = across.x * across.x + across.y * across.y;
  ray.axis = axis;
  ray.beyond_axis = divide(square, axis + square_root(axis * axis + square));
  return ray;
}

// The camera ray through the centre of a pixel of what is traced.
PixelRay pixel_ray(uvec2 pixel) {
  real x = real(pixel.x + params.first_x) + real(0.5);
  real y = real(pixel.y + params.first_y) + real(0.5);
  vec3 to_near = vec3(params.ray_corner) + vec3(params.ray_dx) * x + vec3(params.ray_dy) * y;
  vec2 across = vec2(params.frame_x.w * (x - real(0.5) * real(params.image_width)),
                     params.frame_y.w * (y - real(0.5) * real(params.image_height)));
  return ray_through(to_near, across);
}

// Of the square of a distance between the centre and the ray: 4 roundings of a difference's square, 4 of the square of a
// projection, of which one each is of the whole: at least gamma(8).
const real BALL_ROUNDINGS = real(5e-7);
// Of a place along the ray, which the solver's z, of another sum, is compared with: 8 roundings of each: at least
// gamma(16).
const real PLACE_ROUNDINGS = real(1e-6);

// Whether the ray misses the ball, or its nearest hit, at z in its frame, lies before it. False if that is not certain.
bool misses_ball(PixelRay ray, vec4 ball, real z) {
  vec3 center = vec3(ball) - ray.anchor;
  real along = dot3(center, ray.view);
  real size = dot3(center, center);
  // The first line compares the squared distance of the centre from the ray with the squared radius, with a margin for the
  // rounding errors of `size`.
  return size - along * along > ball.w * ball.w + BALL_ROUNDINGS * size ||
         along + ball.w < ray.frame.stretch * ray.nearest ||
         along - ball.w > ray.frame.stretch * z + PLACE_ROUNDINGS * (ball.w + abs(along));
}

// A ray with a frame of its own.
PixelRay ray_of_cast(CastRay cast_ray) {
  PixelRay ray;
  ray.tile = 0u;
  ray.near_point = vec3(cast_ray.anchor) + vec3(cast_ray.direction) * cast_ray.anchor.w;
  ray.view = vec3(cast_ray.direction);
  ray.anchor = vec3(cast_ray.anchor);
  ray.frame = ray_frame(ray.anchor, ray.view);
  ray.nearest = cast_ray.anchor.w;
  ray.near_distance = cast_ray.anchor.w;
  ray.far_depth = real(1e30);
  ray.axis = real(0.0);
  ray.beyond_axis = real(0.0);
  return ray;
}
