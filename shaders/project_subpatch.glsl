// What a frame's camera sees of a part: where in the image it can be, and the patch in the axes of the camera's frame.

// Where a point of the camera's frame, and all within `radius` of it, is seen: x, y: image position; z: how far
// around it; negative if not all of them lie before the eye.
vec3 project_ball(vec3 p, real radius) {
  real axis = params.anchor.w;
  real before = real(1.0) + p.z / axis;
  real closest = before - radius / axis;
  if (!(closest > real(1e-3))) return vec3(0.0, 0.0, -1.0);
  vec2 across = vec2(p) / before;
  // The shift of (p + d) / (before + d.z / axis) by a d of this length.
  real shift = radius * (real(1.0) + length2(across) / axis) / closest;
  vec2 pixel = vec2(params.frame_x.w, params.frame_y.w);
  vec2 middle = vec2(real(0.5) * real(params.width), real(0.5) * real(params.height));
  return vec3(across / pixel + middle, shift / min(pixel.x, pixel.y));
}

// Draws the box and the lines around what is seen there.
void extend_projection(vec3 seen, INOUT(ProjectedSubpatch) view) {
  vec3 along = vec3(view.lines_x) * seen.x + vec3(view.lines_y) * seen.y + vec3(seen.z);
  vec3 at = max(vec3(view.lines_at), along);
  view.lines_at = vec4(at, 0.0);
  view.box = vec4(min(view.box.x, seen.x - seen.z), min(view.box.y, seen.y - seen.z), max(view.box.z, seen.x + seen.z),
                  max(view.box.w, seen.y + seen.z));
}

// Lets it be seen everywhere.
void make_unbounded(INOUT(ProjectedSubpatch) view) {
  view.box = vec4(real(-1e30), real(-1e30), real(1e30), real(1e30));
  view.lines_at = vec4(real(1e30));
}

// 0 for no length: a line without direction leaves nothing out.
real over_length(real x, vec2 a) {
  real size = length2(a);
  return size > real(0.0) ? x / size : real(0.0);
}

ProjectedSubpatch project_subpatch(uint index) {
  SubpatchBounds bounds = subpatches[index];
  Triangle tri = triangles[bounds.triangle];
  RayFrame frame = camera_frame(vec2(0.0));
  FramedPatch at = rotated_patch(frame, SHELL, tri);
  SubTriangle wide = with_overlap(sub_triangle_at(bounds.sub_triangle, WHOLE));
  ControlNet across = control_net(at, vec3(bounds.corner), vec3(bounds.edge), wide);
  FramedPatch deep;
  deep.P0 = vec3(at.P0.z, 0.0, 0.0);
  deep.P1 = vec3(at.P1.z, 0.0, 0.0);
  deep.P2 = vec3(at.P2.z, 0.0, 0.0);
  deep.D0 = vec3(at.D0.z, 0.0, 0.0);
  deep.D1 = vec3(at.D1.z, 0.0, 0.0);
  deep.D2 = vec3(at.D2.z, 0.0, 0.0);
  ControlNet depth = control_net(deep, vec3(bounds.corner), vec3(bounds.edge), wide);

  RayFrame corner = camera_frame(vec2(real(0.5) * real(params.width) * params.frame_x.w,
                                      real(0.5) * real(params.height) * params.frame_y.w));
  real axial = position_tolerance(frame, tri);
  real radius = bounds.corner.w + real(2.0) * corner.stretch * axial;
  vec3 s0 = project_ball(vec3(across.b300, depth.b300.x), radius);
  vec3 s1 = project_ball(vec3(across.b030, depth.b030.x), radius);
  vec3 s2 = project_ball(vec3(across.b003, depth.b003.x), radius);
  vec3 s3 = project_ball(vec3(across.b210, depth.b210.x), radius);
  vec3 s4 = project_ball(vec3(across.b120, depth.b120.x), radius);
  vec3 s5 = project_ball(vec3(across.b021, depth.b021.x), radius);
  vec3 s6 = project_ball(vec3(across.b012, depth.b012.x), radius);
  vec3 s7 = project_ball(vec3(across.b102, depth.b102.x), radius);
  vec3 s8 = project_ball(vec3(across.b201, depth.b201.x), radius);
  vec3 s9 = project_ball(vec3(across.b111, depth.b111.x), radius);
  real least_width = min(min(min(min(s0.z, s1.z), min(s2.z, s3.z)), min(min(s4.z, s5.z), min(s6.z, s7.z))),
                         min(s8.z, s9.z));

  ProjectedSubpatch view;
  // Normals of the triangle's edges, outward.
  vec2 e0 = vec2(s1) - vec2(s0);
  vec2 e1 = vec2(s2) - vec2(s1);
  vec2 e2 = vec2(s0) - vec2(s2);
  real turn = cross2(e0, e1) < real(0.0) ? real(-1.0) : real(1.0);
  vec3 scale = vec3(over_length(turn, e0), over_length(turn, e1), over_length(turn, e2));
  real begins = min(min(min(min(depth.b300.x, depth.b030.x), min(depth.b003.x, depth.b210.x)),
                        min(min(depth.b120.x, depth.b021.x), min(depth.b012.x, depth.b102.x))),
                    min(depth.b201.x, depth.b111.x));
  view.lines_x = vec4(vec3(e0.y, e1.y, e2.y) * scale, begins - radius);
  view.lines_y = vec4(vec3(-e0.x, -e1.x, -e2.x) * scale, real(bounds.triangle));
  view.lines_at = vec4(vec3(real(-1e30)), 0.0);
  view.box = vec4(real(1e30), real(1e30), real(-1e30), real(-1e30));
  extend_projection(s0, view);
  extend_projection(s1, view);
  extend_projection(s2, view);
  extend_projection(s3, view);
  extend_projection(s4, view);
  extend_projection(s5, view);
  extend_projection(s6, view);
  extend_projection(s7, view);
  extend_projection(s8, view);
  extend_projection(s9, view);
  // Written so that a NaN is seen everywhere.
  if (!(least_width >= real(0.0) && view.box.z - view.box.x < real(1e20))) make_unbounded(view);
  view.P0 = vec4(at.P0, bounds.edge.x);
  view.P1 = vec4(at.P1, bounds.edge.y);
  view.P2 = vec4(at.P2, bounds.edge.z);
  view.D0 = vec4(at.D0, bounds.sub_triangle.x);
  view.D1 = vec4(at.D1, bounds.sub_triangle.y);
  view.D2 = vec4(at.D2, bounds.sub_triangle.z);
  view.cone = bounds.cone;
  view.sizes = vec4(bounds.sub_triangle.w, axial, 0.0, 0.0);
  return view;
}

// Draws the box around what is seen of a ball that holds the part, and no line.
void bound_by_ball(vec4 ball, INOUT(ProjectedSubpatch) view) {
  RayFrame frame = camera_frame(vec2(0.0));
  vec3 center = rotated(frame, vec3(ball) - frame.anchor);
  vec3 seen = project_ball(center, ball.w);
  make_unbounded(view);
  view.lines_x.w = center.z - ball.w;
  if (seen.z >= real(0.0)) view.box = vec4(seen.x - seen.z, seen.y - seen.z, seen.x + seen.z, seen.y + seen.z);
}
