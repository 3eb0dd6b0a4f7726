// Where the sphere surface is over a node, by interval arithmetic: the bound of a part that no quadratic bounds, as
// sigma has a kink there. It has one where lines begin to miss a vertex's sphere, and where a height reaches its limit.
// A range is vec2(least, largest).

// Relative: some roundings of what is added up.
const real RANGE_SLACK = real(1e-6);
const real UNBOUNDED = real(1e30);

vec2 joined(vec2 a, vec2 b) { return vec2(min(a.x, b.x), max(a.y, b.y)); }

vec2 range_of(real a, real b, real c) { return vec2(min(min(a, b), c), max(max(a, b), c)); }

vec2 grown(vec2 a, real by) { return vec2(a.x - by, a.y + by); }

vec2 range_product(vec2 a, vec2 b) {
  vec2 c = a * b.x;
  vec2 d = a * b.y;
  return vec2(min(min(c.x, c.y), min(d.x, d.y)), max(max(c.x, c.y), max(d.x, d.y)));
}

// For b > 0.
vec2 range_quotient(vec2 a, vec2 b) {
  return vec2(a.x / (a.x < real(0.0) ? b.x : b.y), a.y / (a.y < real(0.0) ? b.y : b.x));
}

// Of (sum l_k a_k).(sum l_k b_k): the hull of its Bernstein coefficients.
vec2 dot_range(vec3 a0, vec3 a1, vec3 a2, vec3 b0, vec3 b1, vec3 b2) {
  vec2 edges = range_of(dot3(a0, b1) + dot3(a1, b0), dot3(a1, b2) + dot3(a2, b1), dot3(a2, b0) + dot3(a0, b2));
  return joined(range_of(dot3(a0, b0), dot3(a1, b1), dot3(a2, b2)), edges * real(0.5));
}

// The angle from b to x, both seen from a vertex, that grows backward about the axis.
real signed_angle(vec3 x, vec3 b, vec3 axis) {
  real size = AngleBetween(x, b);
  return dot3(cross3(x, b), axis) < real(0.0) ? -size : size;
}

// Of the vertex's curvature at points with corners x_k seen from it: a convex node spans the angles of its corners.
vec2 curvature_range(vec3 x0, vec3 x1, vec3 x2, vec3 b, vec3 axis, vec4 data) {
  vec2 angle = range_of(signed_angle(x0, b, axis), signed_angle(x1, b, axis), signed_angle(x2, b, axis));
  // Around the vertex, or across the line behind it, at which the angle ends.
  if (angle.x <= real(0.0) && angle.y >= real(0.0) && largest(angle) > real(1.57)) angle = vec2(-UNBOUNDED, UNBOUNDED);
  vec2 blend = clamp(grown(angle / data.z, RANGE_SLACK), vec2(LEAST_BLEND), vec2(MOST_BLEND));
  return grown(vec2(data.y) + range_product(blend, vec2(data.x - data.y)), RANGE_SLACK * (abs(data.x) + abs(data.y)));
}

// Of |D|^2, n the face normal: (D.n)^2 at least, which the coefficients may miss by much where directions turn fast.
vec2 square_range(vec3 D0, vec3 D1, vec3 D2, vec3 n) {
  vec2 DD = dot_range(D0, D1, D2, D0, D1, D2);
  real above = max(range_of(dot3(D0, n), dot3(D1, n), dot3(D2, n)).x, real(0.0));
  return grown(vec2(max(DD.x, above * above), DD.y), RANGE_SLACK * DD.y);
}

// Of s_i over a node with corners x_k seen from vertex i, directions D_k, their square DD and curvatures c.
vec2 sphere_height_range(vec3 x0, vec3 x1, vec3 x2, vec3 D0, vec3 D1, vec3 D2, vec2 DD, vec3 N, vec2 c) {
  vec2 xx = dot_range(x0, x1, x2, x0, x1, x2);
  vec2 xD = dot_range(x0, x1, x2, D0, D1, D2);
  vec2 DN = range_of(dot3(D0, N), dot3(D1, N), dot3(D2, N));
  vec2 xN = range_of(dot3(x0, N), dot3(x1, N), dot3(x2, N));
  real D = sqrt(DD.y);
  real x = sqrt(xx.y);
  xx = grown(xx, RANGE_SLACK * xx.y);
  vec2 A = range_product(c, DD);
  vec2 B = range_product(c, grown(xD, RANGE_SLACK * x * D)) + grown(DN, RANGE_SLACK * D);
  vec2 C = range_product(c, xx) + grown(xN, RANGE_SLACK * x) * real(2.0);
  vec2 AC = range_product(A, C);
  real least_B = B.x > real(0.0) ? B.x : B.y < real(0.0) ? -B.y : real(0.0);
  vec2 BB = vec2(least_B * least_B, largest(B) * largest(B));
  vec2 discriminant = grown(vec2(BB.x - AC.y, BB.y - AC.x), RANGE_SLACK * (BB.y + largest(AC)));
  vec2 root = sqrt(max(discriminant, vec2(0.0)));
  // sphere_root: (root - B) / A, or -C / (B + root); where the line misses the sphere B^2 <= A C, so that -B / A lies
  // between 0 and -C / B.
  vec2 s = vec2(-UNBOUNDED, UNBOUNDED);
  if (A.x > real(0.0)) s = range_quotient(vec2(root.x - B.y, root.y - B.x), A);
  if (A.y < real(0.0)) s = range_quotient(vec2(B.x - root.y, B.y - root.x), vec2(-A.y, -A.x));
  if (B.x > real(0.0)) {
    vec2 other = range_quotient(vec2(-C.y, -C.x), B + root);
    if (discriminant.x <= real(0.0)) {
      other = joined(joined(other, range_quotient(vec2(-C.y, -C.x), B)), vec2(0.0));
    }
    s = vec2(max(s.x, other.x), min(s.y, other.y));
  }
  // height_limit, and the root held within it.
  vec2 size = sqrt(max(DD, vec2(real(1e-20))));
  DN = grown(DN, RANGE_SLACK * D);
  vec2 limit = clamp(range_quotient(DN, FLAT_SINE * size), vec2(0.0), vec2(1.0)) * sqrt(max(xx, vec2(0.0))) /
               vec2(size.y, size.x);
  limit = vec2(limit.x * (real(1.0) - RANGE_SLACK), limit.y * (real(1.0) + RANGE_SLACK));
  s = grown(s, RANGE_SLACK * min(largest(s), limit.y));
  return vec2(s.x > real(0.0) ? min(s.x, limit.x) : max(s.x, -limit.y),
              s.y > real(0.0) ? min(s.y, limit.y) : max(s.y, -limit.x));
}

// Of sigma over a node of the sphere surface.
vec2 sphere_range(Shape shape, Triangle tri, Node node) {
  vec3 a = weights_of(node, vec3(1.0, 0.0, 0.0));
  vec3 b = weights_of(node, vec3(0.0, 1.0, 0.0));
  vec3 c = weights_of(node, vec3(0.0, 0.0, 1.0));
  vec3 Ta = base_point(tri, a);
  vec3 Tb = base_point(tri, b);
  vec3 Tc = base_point(tri, c);
  vec3 Da = shell_direction(shape.shell, tri, a);
  vec3 Db = shell_direction(shape.shell, tri, b);
  vec3 Dc = shell_direction(shape.shell, tri, c);
  vec3 end = node.origin + vec3(node.size);
  vec3 low = min(node.origin, end);
  vec3 high = max(node.origin, end);
  vec2 DD = square_range(Da, Db, Dc, vec3(tri.TriNormal));
  vec2 sigma = vec2(0.0);
  for (int i = 0; i < 3; ++i) {
    vec3 P = vec3(tri.Position[i]);
    vec3 neighbour = vec3(tri.Position[i == 2 ? 1 : 2]);
    vec4 data = tri.VertexData[i];
    vec3 axis = i == 1 ? -vec3(tri.TriNormal) : vec3(tri.TriNormal);
    vec2 curvature = curvature_range(Ta - P, Tb - P, Tc - P, neighbour - P, axis, data);
    vec2 s = sphere_height_range(Ta - P, Tb - P, Tc - P, Da, Db, Dc, DD, vec3(tri.Normal[i]), curvature);
    sigma += range_product(vec2(low[i], high[i]), s);
  }
  return grown(sigma, RANGE_SLACK * largest(sigma));
}

// Whether a node of a part with a kink comes within `reach` of the ray: it lies in the hull of its corners, each
// displaced by the least and by the largest sigma.
bool kinked_near_ray(Shape shape, Triangle tri, FramedPatch framed, Node node, real reach) {
  vec2 sigma = sphere_range(shape, tri, node);
  vec3 a = weights_of(node, vec3(1.0, 0.0, 0.0));
  vec3 b = weights_of(node, vec3(0.0, 1.0, 0.0));
  vec3 c = weights_of(node, vec3(0.0, 0.0, 1.0));
  vec2 Da = vec2(weigh(a, framed.D0, framed.D1, framed.D2));
  vec2 Db = vec2(weigh(b, framed.D0, framed.D1, framed.D2));
  vec2 Dc = vec2(weigh(c, framed.D0, framed.D1, framed.D2));
  Net net;
  net.b300 = vec2(weigh(a, framed.P0, framed.P1, framed.P2)) + Da * sigma.x;
  net.b030 = vec2(weigh(b, framed.P0, framed.P1, framed.P2)) + Db * sigma.x;
  net.b003 = vec2(weigh(c, framed.P0, framed.P1, framed.P2)) + Dc * sigma.x;
  net.b210 = net.b300 + Da * (sigma.y - sigma.x);
  net.b120 = net.b030 + Db * (sigma.y - sigma.x);
  net.b021 = net.b003 + Dc * (sigma.y - sigma.x);
  net.b012 = net.b021;
  net.b102 = net.b021;
  net.b201 = net.b021;
  net.b111 = net.b021;
  return near_ray(net, reach) && !beside(net, Da + Db + Dc, reach);
}
