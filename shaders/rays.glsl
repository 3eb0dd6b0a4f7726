// The rays: a pixel's, and those that are cast one by one. Reads params.

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

// Whether the ray passes the ball by, or has met something before it, at z in its frame.
bool misses_ball(PixelRay ray, vec4 ball, real z) {
  vec3 center = vec3(ball) - ray.anchor;
  real along = dot3(center, ray.view);
  real size = dot3(center, center);
  // The distance of the centre from the ray against the radius; the roundings of `size` may add to it.
  return size - along * along > ball.w * ball.w + real(5e-7) * size ||
         along + ball.w < ray.frame.stretch * ray.nearest ||
         along - ball.w > ray.frame.stretch * z + real(1e-6) * (ball.w + abs(along));
}

PixelRay ray_of_cast(CastRay asked) {
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
