// Where the sphere surface is over a node, and how steep, by interval arithmetic: what bounds a part that no quadratic
// bounds, as sigma has a kink there. It has one where lines begin to miss a vertex's sphere, and where a height reaches
// its limit. Between two points sigma changes by a mean of its derivatives along the way, a kink or not; only where lines
// begin to miss are they not bounded. A range is vec2(least, largest).

// Relative: some roundings of what is added up.
const real RANGE_SLACK = real(1e-6);
const real UNBOUNDED = real(1e30);

vec2 joined(vec2 a, vec2 b) { return vec2(min(a.x, b.x), max(a.y, b.y)); }

vec2 range_both(vec2 a, vec2 b) { return vec2(max(a.x, b.x), min(a.y, b.y)); }

vec2 range_of(real a, real b, real c) { return vec2(min(min(a, b), c), max(max(a, b), c)); }

vec2 grown(vec2 a, real by) { return vec2(a.x - by, a.y + by); }

vec2 minus(vec2 a) { return vec2(-a.y, -a.x); }

vec2 range_product(vec2 a, vec2 b) {
  vec2 c = a * b.x;
  vec2 d = a * b.y;
  return vec2(min(min(c.x, c.y), min(d.x, d.y)), max(max(c.x, c.y), max(d.x, d.y)));
}

// For b > 0.
vec2 range_quotient(vec2 a, vec2 b) {
  return vec2(a.x / (a.x < real(0.0) ? b.x : b.y), a.y / (a.y < real(0.0) ? b.y : b.x));
}

vec2 range_square(vec2 a) {
  real least_size = max(max(a.x, -a.y), real(0.0));
  return vec2(least_size * least_size, largest(a) * largest(a));
}

vec2 range_root(vec2 a) { return sqrt(max(a, vec2(0.0))); }

Corners at_corners(SubTriangle node, vec3 v0, vec3 v1, vec3 v2) {
  Corners at;
  at.a = weigh(weights_of(node, vec3(1.0, 0.0, 0.0)), v0, v1, v2);
  at.b = weigh(weights_of(node, vec3(0.0, 1.0, 0.0)), v0, v1, v2);
  at.c = weigh(weights_of(node, vec3(0.0, 0.0, 1.0)), v0, v1, v2);
  return at;
}

real longest(Corners p) { return sqrt(max(max(dot3(p.a, p.a), dot3(p.b, p.b)), dot3(p.c, p.c))); }

// Of p.q.
vec2 linear_range(Corners p, vec3 q) {
  return grown(range_of(dot3(p.a, q), dot3(p.b, q), dot3(p.c, q)), RANGE_SLACK * longest(p) * length3(q));
}

// Of p.q, the hull of its Bernstein coefficients.
vec2 product_range(Corners p, Corners q) {
  vec2 edges = range_of(dot3(p.a, q.b) + dot3(p.b, q.a), dot3(p.b, q.c) + dot3(p.c, q.b),
                        dot3(p.c, q.a) + dot3(p.a, q.c));
  return grown(joined(range_of(dot3(p.a, q.a), dot3(p.b, q.b), dot3(p.c, q.c)), edges * real(0.5)),
               RANGE_SLACK * longest(p) * longest(q));
}

// Of |D|^2, n the face normal: (D.n)^2 at least, which the coefficients may miss by much where directions turn fast.
vec2 square_range(Corners D, vec3 n) {
  vec2 DD = product_range(D, D);
  real above = max(linear_range(D, n).x, real(0.0));
  return vec2(max(DD.x, above * above), DD.y);
}

// The angle from b to x, both seen from a vertex, that grows backward about the axis.
real signed_angle(vec3 x, vec3 b, vec3 axis) {
  real size = AngleBetween(x, b);
  return dot3(cross3(x, b), axis) < real(0.0) ? -size : size;
}

// Of curvature_blend at points x seen from the vertex: a convex node spans the angles of its corners. All where the node
// is around the vertex, or across the line behind it, at which the angle ends.
vec2 blend_range(Corners x, vec3 b, vec3 axis, vec4 data) {
  vec2 angle = range_of(signed_angle(x.a, b, axis), signed_angle(x.b, b, axis), signed_angle(x.c, b, axis));
  if (angle.x <= real(0.0) && angle.y >= real(0.0) && largest(angle) > real(1.57)) angle = vec2(-UNBOUNDED, UNBOUNDED);
  return clamp(grown(angle / data.z, RANGE_SLACK), vec2(LEAST_BLEND), vec2(MOST_BLEND));
}

// Of sphere_root, from its A, B, C and the square root of its discriminant.
vec2 root_range(vec2 A, vec2 B, vec2 C, vec2 root) {
  vec2 s = vec2(-UNBOUNDED, UNBOUNDED);
  if (A.x > real(0.0)) s = range_quotient(root + minus(B), A);
  if (A.y < real(0.0)) s = range_quotient(B + minus(root), minus(A));
  if (B.x > real(0.0)) {
    // -C / (B + root); where the line misses the sphere B^2 <= A C, so that -B / A lies between 0 and -C / B.
    vec2 other = range_quotient(minus(C), B + root);
    if (root.x <= real(0.0)) other = joined(joined(other, range_quotient(minus(C), B)), vec2(0.0));
    s = range_both(s, other);
  }
  return grown(s, RANGE_SLACK * largest(s));
}

// What s_i and its derivatives are made of, over a node.
struct HeightRange {
  Corners x;   // seen from the vertex
  Corners D;
  vec3 N;
  vec3 turn;   // about which the angle of the curvature's blend grows
  vec2 c;      // curvature
  vec2 rate;   // of c with the angle
  vec2 xx;
  vec2 xD;
  vec2 DD;
  vec2 DN;
  vec2 A;
  vec2 discriminant;
  vec2 root;   // its square root
  vec2 held;   // s_i
  vec2 s;      // before it is held within the limit
  vec2 limit_slope;  // the limit over |x|
  vec2 limit;
};

HeightRange height_range(Triangle tri, int i, Corners T, Corners D, vec2 DD) {
  vec3 P = vec3(tri.Position[i]);
  vec4 data = tri.VertexData[i];
  HeightRange h;
  h.x.a = T.a - P;
  h.x.b = T.b - P;
  h.x.c = T.c - P;
  h.D = D;
  h.N = vec3(tri.Normal[i]);
  h.turn = i == 1 ? vec3(tri.TriNormal) : -vec3(tri.TriNormal);
  vec2 blend = blend_range(h.x, vec3(tri.Position[i == 2 ? 1 : 2]) - P, -h.turn, data);
  real change = data.x - data.y;
  h.c = grown(vec2(data.y) + range_product(blend, vec2(change)), RANGE_SLACK * (abs(data.x) + abs(data.y)));
  h.rate = vec2(change / data.z);
  if (blend.x <= LEAST_BLEND || blend.y >= MOST_BLEND) h.rate = joined(h.rate, vec2(0.0));
  // Across the line behind the vertex c jumps.
  if (blend.x <= LEAST_BLEND && blend.y >= MOST_BLEND) h.rate = vec2(-UNBOUNDED, UNBOUNDED);
  h.xx = max(product_range(h.x, h.x), vec2(0.0));
  h.xD = product_range(h.x, D);
  h.DD = DD;
  h.DN = linear_range(D, h.N);
  h.A = range_product(h.c, DD);
  vec2 B = range_product(h.c, h.xD) + h.DN;
  vec2 C = range_product(h.c, h.xx) + linear_range(h.x, h.N) * real(2.0);
  vec2 AC = range_product(h.A, C);
  vec2 BB = range_square(B);
  h.discriminant = grown(BB + minus(AC), RANGE_SLACK * (BB.y + largest(AC)));
  h.root = range_root(h.discriminant);
  h.s = root_range(h.A, B, C, h.root);
  // height_limit.
  vec2 size = range_root(max(DD, vec2(real(1e-20))));
  h.limit_slope = range_quotient(clamp(range_quotient(h.DN, size * FLAT_SINE), vec2(0.0), vec2(1.0)), size);
  h.limit = h.limit_slope * range_root(h.xx) * vec2(real(1.0) - RANGE_SLACK, real(1.0) + RANGE_SLACK);
  h.held = vec2(h.s.x > real(0.0) ? min(h.s.x, h.limit.x) : max(h.s.x, -h.limit.y),
                h.s.y > real(0.0) ? min(h.s.y, h.limit.y) : max(h.s.y, -h.limit.x));
  return h;
}

// Of the limit's derivative as T moves by dT and D by dD. The limit is |x| times its reach, which is 1 / |D|, (D.N) / |D|^2
// over FLAT_SINE, or 0 (height_limit).
vec2 limit_change(HeightRange h, vec3 dT, vec3 dD) {
  vec2 far = range_root(h.xx);
  real step = length3(dT);
  vec2 away = vec2(-step, step);
  if (far.x > real(0.0)) away = range_both(away, range_quotient(linear_range(h.x, dT), far));
  vec2 turned = range_product(h.limit_slope, range_quotient(linear_range(h.D, dD), h.DD));
  vec2 sine = range_quotient(h.DN, range_root(h.DD) * FLAT_SINE);
  vec2 slope_change = vec2(UNBOUNDED, -UNBOUNDED);
  if (sine.y >= real(1.0)) slope_change = minus(turned);
  if (sine.x <= real(0.0)) slope_change = joined(slope_change, vec2(0.0));
  if (sine.x < real(1.0) && sine.y > real(0.0)) {
    vec2 of_sine = range_quotient(vec2(dot3(dD, h.N)), h.DD * FLAT_SINE);
    slope_change = joined(slope_change, of_sine + minus(turned) * real(2.0));
  }
  return range_product(away, h.limit_slope) + range_product(slope_change, far);
}

// Of s_i's derivative there (sphere_gradient).
vec2 height_change(HeightRange h, vec3 dT, vec3 dD) {
  vec2 unbounded = vec2(-UNBOUNDED, UNBOUNDED);
  vec2 change = vec2(UNBOUNDED, -UNBOUNDED);
  if (largest(h.s) >= h.limit.x) {
    vec2 of_limit = limit_change(h, dT, dD);
    if (h.s.y > real(0.0)) change = of_limit;
    if (h.s.x < real(0.0)) change = joined(change, minus(of_limit));
    if (h.s.x > h.limit.y || h.s.y < -h.limit.y) return change;
  }
  vec2 s = h.held;
  vec2 xd = linear_range(h.x, dD);
  vec2 Dd = linear_range(h.D, dD);
  vec2 turning = range_product(linear_range(h.x, cross3(dT, h.turn)), h.rate);
  real slack = RANGE_SLACK * (length3(dT) + largest(s) * length3(dD));
  if (h.discriminant.y <= real(0.0)) {
    // s A = -B.
    vec2 size = h.A.x > real(0.0) ? h.A : minus(h.A);
    if (!(size.x > real(0.0) && h.xx.x > real(0.0))) return unbounded;
    vec2 pD = h.xD + range_product(s, h.DD);
    vec2 rise = range_product(turning, range_quotient(pD, h.xx)) + vec2(dot3(h.N, dD)) +
                range_product(h.c, linear_range(h.D, dT) + xd + range_product(s, Dd) * real(2.0));
    vec2 fall = h.A.x > real(0.0) ? minus(rise) : rise;
    return joined(change, range_quotient(grown(fall, slack), size));
  }
  if (!(h.root.x > real(0.0))) return unbounded;
  // |p|^2 / |x|^2, p = x + s D: at most 4, as |s D| is held to |x|.
  vec2 ss = range_square(s);
  vec2 pp = max(h.xx + range_product(s, h.xD) * real(2.0) + range_product(ss, h.DD), vec2(0.0));
  vec2 farther = vec2(0.0, 4.0);
  if (h.xx.x > real(0.0)) farther = range_both(farther, range_quotient(pp, h.xx));
  vec2 p_change = linear_range(h.x, dT) + range_product(s, xd + linear_range(h.D, dT)) + range_product(ss, Dd);
  vec2 rise = range_product(turning, farther) * real(0.5) + range_product(h.c, p_change) + vec2(dot3(h.N, dT)) +
              range_product(s, vec2(dot3(h.N, dD)));
  return joined(change, range_quotient(grown(minus(rise), slack), h.root));
}

// Of D with the weight i, 1 or 2.
vec3 direction_change(Shape shape, Triangle tri, int i) {
  return corner_direction(shape.shell, tri.Normal[i], tri.NormDot[i]) -
         corner_direction(shape.shell, tri.Normal[0], tri.NormDot.x);
}

// The base triangle, the directions, their squares and the weights over a node.
struct SphereOverSubTriangle {
  Corners T;
  Corners D;
  vec2 DD;
  vec3 least_weights;
  vec3 largest_weights;
};

SphereOverSubTriangle sphere_node(Shape shape, Triangle tri, SubTriangle node) {
  SphereOverSubTriangle over;
  over.T = at_corners(node, vec3(tri.Position[0]), vec3(tri.Position[1]), vec3(tri.Position[2]));
  over.D = at_corners(node, corner_direction(shape.shell, tri.Normal[0], tri.NormDot.x),
                      corner_direction(shape.shell, tri.Normal[1], tri.NormDot.y),
                      corner_direction(shape.shell, tri.Normal[2], tri.NormDot.z));
  over.DD = square_range(over.D, vec3(tri.TriNormal));
  vec3 end = node.origin + vec3(node.size);
  over.least_weights = min(node.origin, end);
  over.largest_weights = max(node.origin, end);
  return over;
}

// Of sigma and its derivatives along u and v; UNBOUNDED where nothing is known of those.
SphereRange sphere_range(Shape shape, Triangle tri, SphereOverSubTriangle over) {
  vec3 Du = direction_change(shape, tri, 1);
  vec3 Dv = direction_change(shape, tri, 2);
  vec3 Tu = vec3(tri.Position[1]) - vec3(tri.Position[0]);
  vec3 Tv = vec3(tri.Position[2]) - vec3(tri.Position[0]);
  SphereRange sigma;
  sigma.s = vec2(0.0);
  sigma.u = vec2(0.0);
  sigma.v = vec2(0.0);
  for (int i = 0; i < 3; ++i) {
    HeightRange h = height_range(tri, i, over.T, over.D, over.DD);
    vec2 w = vec2(over.least_weights[i], over.largest_weights[i]);
    sigma.s += range_product(w, h.held);
    sigma.u += range_product(w, height_change(h, Tu, Du));
    sigma.v += range_product(w, height_change(h, Tv, Dv));
    if (i != 2) sigma.u += i == 1 ? h.held : minus(h.held);
    if (i != 1) sigma.v += i == 2 ? h.held : minus(h.held);
  }
  sigma.s = grown(sigma.s, RANGE_SLACK * largest(sigma.s));
  // Written so that a NaN bounds nothing.
  bool bounded = over.DD.x > real(0.0) && max(largest(sigma.u), largest(sigma.v)) < real(1e-10) * UNBOUNDED;
  if (!bounded) {
    sigma.u = vec2(-UNBOUNDED, UNBOUNDED);
    sigma.v = vec2(-UNBOUNDED, UNBOUNDED);
  }
  return sigma;
}

// Whether a node displaced by sigma comes within `reach` of the ray: it lies in the hull of its corners, each displaced
// by the least and by the largest sigma.
bool prism_overlaps_ray(FramedPatch framed, SubTriangle node, vec2 sigma, real tolerance) {
  Corners T = at_corners(node, framed.P0, framed.P1, framed.P2);
  Corners D = at_corners(node, framed.D0, framed.D1, framed.D2);
  ControlNet net;
  net.b300 = vec2(T.a) + vec2(D.a) * sigma.x;
  net.b030 = vec2(T.b) + vec2(D.b) * sigma.x;
  net.b003 = vec2(T.c) + vec2(D.c) * sigma.x;
  net.b210 = net.b300 + vec2(D.a) * (sigma.y - sigma.x);
  net.b120 = net.b030 + vec2(D.b) * (sigma.y - sigma.x);
  net.b021 = net.b003 + vec2(D.c) * (sigma.y - sigma.x);
  net.b012 = net.b021;
  net.b102 = net.b021;
  net.b201 = net.b021;
  net.b111 = net.b021;
  return hull_overlaps_ray(net, tolerance) && !separated_along(net, vec2(D.a) + vec2(D.b) + vec2(D.c), tolerance);
}

// Whether a node of a part with a kink comes within `reach` of the ray, as far as sigma's range tells, and if it does a
// quadratic for it: linear, with the middles of the derivatives' ranges, or constant.
bool ranged_fit(Shape shape, Triangle tri, FramedPatch framed, SubTriangle node, real tolerance, OUT(Fit) fit,
                INOUT(uint) evaluations) {
  SphereOverSubTriangle over = sphere_node(shape, tri, node);
  SphereRange sigma = sphere_range(shape, tri, over);
  real D = longest(over.D);
  fit.corner = vec3(real(0.5) * (sigma.s.x + sigma.s.y));
  fit.edge = fit.corner;
  fit.position_error = real(0.5) * (sigma.s.y - sigma.s.x) * D;
  fit.tangent_error = UNBOUNDED;
  if (!prism_overlaps_ray(framed, node, sigma.s, tolerance)) return false;
  if (sigma.u.y >= UNBOUNDED) return true;
  vec3 c = centre_of(node);
  vec2 middle = vec2(sigma.u.x + sigma.u.y, sigma.v.x + sigma.v.y) * real(0.5);
  vec2 off = vec2(sigma.u.y - sigma.u.x, sigma.v.y - sigma.v.x) * real(0.5);
  fit.corner = vec3(0.0);
  fit.edge = vec3(0.0);
  add_linear(fit, c, displacement(shape, tri, c), middle);
  ++evaluations;
  // From the centre to a corner one of the weights 1 and 2 changes by a third of the size and the other by two, or both
  // by a third.
  real position_error = (off.x + off.y + largest(off)) * abs(node.size) / real(3.0);
  real turned = max(length3(direction_change(shape, tri, 1)), length3(direction_change(shape, tri, 2)));
  fit.position_error = position_error * D;
  fit.tangent_error = largest(off) * D + position_error * turned;
  return true;
}
