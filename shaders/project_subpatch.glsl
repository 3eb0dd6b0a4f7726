// What a frame's camera sees of a subpatch: where in the image it can be, and the patch in the camera's axes.

// The image of a ball of the camera's frame, in pixels; x, y: of its centre; z: how far around that any of its points is
// seen. z is negative if part of the ball is not before the eye.
vec3 project_ball(vec3 p, real radius) {
  real axis = params.anchor.w;
  real before = real(1.0) + p.z / axis;
  real closest = before - radius / axis;
  if (!(closest > real(1e-3))) return vec3(0.0, 0.0, -1.0);
  vec2 across = vec2(p) / before;
  // By so much (p + d).xy / (before + d.z / axis) may differ from p.xy / before, |d| <= radius.
  real shift = radius * (real(1.0) + length2(across) / axis) / closest;
  vec2 pixel = vec2(params.frame_x.w, params.frame_y.w);
  vec2 middle = vec2(real(0.5) * real(params.image_width) - real(params.first_x),
                     real(0.5) * real(params.image_height) - real(params.first_y));
  return vec3(across / pixel + middle, shift / min(pixel.x, pixel.y));
}

// Extends the box and moves the lines outward to include the image of a ball, `seen` as project_ball gives it.
void extend_projection(vec3 seen, INOUT(ProjectedSubpatch) view) {
  vec3 along = vec3(view.lines_x) * seen.x + view.lines_y * seen.y + vec3(seen.z);
  vec3 at = max(vec3(view.lines_at), along);
  view.lines_at = vec4(at, view.lines_at.w);
  view.box = vec4(min(view.box.x, seen.x - seen.z), min(view.box.y, seen.y - seen.z), max(view.box.z, seen.x + seen.z),
                  max(view.box.w, seen.y + seen.z));
}

// Nothing is known of where it is seen.
void make_unbounded(INOUT(ProjectedSubpatch) view) {
  view.box = vec4(real(-1e30), real(-1e30), real(1e30), real(1e30));
  view.lines_at = vec4(vec3(real(1e30)), view.lines_at.w);
}

// A depth at which something begins, for subpatches to be sorted by. What is not a depth is before all else.
real sortable(real z) { return abs(z) < real(1e30) ? z : real(-1e30); }

// x / |a|, or 0 if |a| is: a line whose normal is 0 leaves nothing out.
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
  ControlNet3D net = control_net_3d(at, vec3(bounds.corner), vec3(bounds.edge), wide);

  // The ray of an image corner is the most slanted, so its tolerance is the largest.
  RayFrame corner = camera_frame(vec2(real(0.5) * real(params.image_width) * params.frame_x.w,
                                      real(0.5) * real(params.image_height) * params.frame_y.w));
  real axial = position_tolerance(frame, tri);
  real radius = bounds.corner.w + real(2.0) * corner.stretch * axial;
  vec3 s0 = project_ball(net.b300, radius);
  vec3 s1 = project_ball(net.b030, radius);
  vec3 s2 = project_ball(net.b003, radius);
  vec3 s3 = project_ball(net.b210, radius);
  vec3 s4 = project_ball(net.b120, radius);
  vec3 s5 = project_ball(net.b021, radius);
  vec3 s6 = project_ball(net.b012, radius);
  vec3 s7 = project_ball(net.b102, radius);
  vec3 s8 = project_ball(net.b201, radius);
  vec3 s9 = project_ball(net.b111, radius);
  real least_width = min(min(min(min(s0.z, s1.z), min(s2.z, s3.z)), min(min(s4.z, s5.z), min(s6.z, s7.z))),
                         min(s8.z, s9.z));

  ProjectedSubpatch view;
  // Lines along the edges of the triangle of its corners, with outward normals.
  vec2 e0 = vec2(s1) - vec2(s0);
  vec2 e1 = vec2(s2) - vec2(s1);
  vec2 e2 = vec2(s0) - vec2(s2);
  real turn = cross2(e0, e1) < real(0.0) ? real(-1.0) : real(1.0);
  vec3 scale = vec3(over_length(turn, e0), over_length(turn, e1), over_length(turn, e2));
  real begins = min(min(min(min(net.b300.z, net.b030.z), min(net.b003.z, net.b210.z)),
                        min(min(net.b120.z, net.b021.z), min(net.b012.z, net.b102.z))),
                    min(net.b201.z, net.b111.z));
  view.lines_x = vec4(vec3(e0.y, e1.y, e2.y) * scale, sortable(begins - radius));
  view.lines_y = vec3(-e0.x, -e1.x, -e2.x) * scale;
  view.triangle = bounds.triangle;
  view.lines_at = vec4(vec3(real(-1e30)), bounds.corner.x);
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
  // Written so that a NaN bounds nothing.
  if (!(least_width >= real(0.0) && view.box.z - view.box.x < real(1e20))) make_unbounded(view);
  view.P0 = vec4(at.P0, bounds.edge.x);
  view.P1 = vec4(at.P1, bounds.edge.y);
  view.P2 = vec4(at.P2, bounds.edge.z);
  view.D0 = vec4(at.D0, bounds.sub_triangle.x);
  view.D1 = vec4(at.D1, bounds.sub_triangle.y);
  view.D2 = vec4(at.D2, bounds.sub_triangle.z);
  view.cone = bounds.cone;
  view.sizes = vec4(bounds.sub_triangle.w, axial, bounds.corner.y, bounds.corner.z);
  return view;
}

// Replaces the bounds by the box around the image of a ball that contains the subpatch. The lines leave nothing out.
void bound_by_ball(vec4 ball, INOUT(ProjectedSubpatch) view) {
  RayFrame frame = camera_frame(vec2(0.0));
  vec3 center = rotated(frame, vec3(ball) - frame.anchor);
  vec3 seen = project_ball(center, ball.w);
  make_unbounded(view);
  view.lines_x.w = sortable(center.z - ball.w);
  if (seen.z >= real(0.0)) view.box = vec4(seen.x - seen.z, seen.y - seen.z, seen.x + seen.z, seen.y + seen.z);
}
