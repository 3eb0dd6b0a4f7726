// Ranges of the sphere surface's displacement sigma = sum w_i s_i (surface.glsl) and of its derivatives over a sub-triangle
// of a patch, by interval arithmetic on the closed form. The kernels bound nonsmooth subpatches with them, which no
// quadratic follows: sigma is not differentiable where lines begin to miss a vertex's sphere and where a height reaches its
// limit. The host proves with the same text, in double precision, where subpatches are smooth and how far they are
// displaced (app/surface/sphere_range.h).
//
// Sigma is Lipschitz but where lines begin to miss a sphere. Between two points it therefore changes by a mean of elements
// of its generalised gradient (Clarke 1983, "Optimization and Nonsmooth Analysis", theorem 2.3.7) along the segment, and a
// range that holds the derivatives on both sides of such a curve bounds the change across it. Where lines begin to miss,
// the derivatives are unbounded, and so is their range.
//
// Roundings. In double precision every operation on ranges rounds outward, so only numbers computed without ranges need a
// slack: dot products, with an error of gamma(3) |p| |q| whatever cancels in them (Higham, "Accuracy and Stability of
// Numerical Algorithms", 2nd ed., section 3.1), the factors in them, and the corners, whose own error is Corners::error.
// In single precision the operations do not round outward. The slacks cover the largest of the roundings there, which the
// tests compare with samples, and the kernels' tolerance of a position covers the corners.

// Relative to the product of the factors' sizes. A dot product of computed vectors takes 3 roundings; its factors are
// differences of vertices, 1, or the cross product of one with the face normal, whose error is 2 gamma(2) of its length and
// the normal's 6; halving and adding two products takes 1 more, and the sizes themselves, rounded, 1. In single precision it
// is at least that much; the quadratics of nodes, and with them a root's last digits, depend on it.
const real RANGE_SLACK = BY_PRECISION(real(1e-6), GAMMA(16));
// Stands for infinity: no length or derivative of a scene comes near.
const real UNBOUNDED = real(1e30);
// A direction whose square is smaller counts as this long. Callers that prove something must not ask there.
const real LEAST_DIRECTION_SQUARE = real(1e-20);

// A linear vector function of the weights, by its values at the corners of a sub-triangle.
struct Corners {
  vec3 a;
  vec3 b;
  vec3 c;
  real error;  // of each value, a length; used in double precision only
};

// Ranges of sigma and of its derivatives along u and v over a sub-triangle.
struct SphereRange {
  Range s;
  Range u;
  Range v;
};

Range unbounded_range() { return between(-UNBOUNDED, UNBOUNDED); }

Range point_range(real a) { return between(a, a); }

Range range_of(real a, real b, real c) { return between(min(min(a, b), c), max(max(a, b), c)); }

real longest(Corners p) { return sqrt(max(max(dot3(p.a, p.a), dot3(p.b, p.b)), dot3(p.c, p.c))); }

// Range of p.q for two vectors.
Range dot_range(vec3 p, vec3 q) {
  return range_grown(point_range(dot3(p, q)), FOR_PROOF(RANGE_SLACK * length3(p) * length3(q)));
}

// Range of p.q over the sub-triangle, q constant.
Range linear_range(Corners p, vec3 q) {
  return range_grown(range_of(dot3(p.a, q), dot3(p.b, q), dot3(p.c, q)),
                     RANGE_SLACK * longest(p) * length3(q) + FOR_PROOF(p.error * length3(q)));
}

// Range of p.q over the sub-triangle: the hull of its Bernstein coefficients.
Range product_range(Corners p, Corners q) {
  Range edges = range_of(dot3(p.a, q.b) + dot3(p.b, q.a), dot3(p.b, q.c) + dot3(p.c, q.b),
                         dot3(p.c, q.a) + dot3(p.a, q.c));
  Range corners = range_of(dot3(p.a, q.a), dot3(p.b, q.b), dot3(p.c, q.c));
  return range_grown(range_hull(corners, between(edges.lo * real(0.5), edges.hi * real(0.5))),
                     RANGE_SLACK * longest(p) * longest(q) +
                       FOR_PROOF(p.error * (longest(q) + q.error) + q.error * longest(p)));
}

// Range of |D|^2, n the face normal. It is at least (D.n)^2, which the Bernstein coefficients may fall far below where
// directions turn fast.
Range square_range(Corners D, vec3 n) {
  Range DD = product_range(D, D);
  real above = max(linear_range(D, n).lo, real(0.0));
  return between(max(DD.lo, range_square(point_range(above)).lo), DD.hi);
}

// The angle, no less, by which a vector of a size may turn if it is off by `error`: pi / 2 times error / size, or any if
// that is no shorter.
real most_turned(real error, real size) { return error < size ? real(2.0) * error / size : real(4.0); }

// Range of the angle from b to x, both seen from a vertex, that grows backward about the axis. x may be off by `error`. A
// corner at the vertex itself has no angle and counts as 0, the angle of an edge, which the other two corners span then.
Range angle_range(vec3 x, real error, vec3 b, vec3 axis) {
  real size = AngleBetween(x, b);
  real angle = dot3(cross3(x, b), axis) < real(0.0) ? -size : size;
  // The sine and the cosine are off by 4 and 3 roundings of |x| |b|, the angle by half a unit in the last place of pi.
  return range_grown(point_range(angle),
                     FOR_PROOF(GAMMA(16) + (size > real(0.0) ? most_turned(error, length3(x)) : real(0.0))));
}

// Range of curvature_blend at points x seen from the vertex: a convex sub-triangle spans the angles of its corners. It is
// the whole range where the sub-triangle lies around the vertex, or across the line behind it, at which the angle jumps
// from pi to -pi.
Range blend_range(Corners x, vec3 b, vec3 axis, vec4 data) {
  Range angle = range_hull(range_hull(angle_range(x.a, x.error, b, axis), angle_range(x.b, x.error, b, axis)),
                           angle_range(x.c, x.error, b, axis));
  bool around = angle.lo <= real(0.0) && angle.hi >= real(0.0) && range_magnitude(angle) > real(1.57);
  if (around || FOR_PROOF(range_magnitude(angle)) > real(3.141592653589793)) angle = unbounded_range();
  Range blend = range_grown(range_quotient(angle, point_range(data.z)), RANGE_SLACK);
  return range_clamp(blend, LEAST_BLEND, MOST_BLEND);
}

// Range of sphere_root, from the ranges of its A, B, C and of the square root of its discriminant.
Range root_range(Range A, Range B, Range C, Range root) {
  Range s = unbounded_range();
  // (root - B) / A, whether the line meets the sphere or not.
  if (A.lo > real(0.0)) s = range_quotient(range_sum(root, range_minus(B)), A);
  if (A.hi < real(0.0)) s = range_quotient(range_sum(B, range_minus(root)), range_minus(A));
  if (B.lo > real(0.0)) {
    // -C / (B + root); where the line misses the sphere B^2 <= A C, so that -B / A lies between 0 and -C / B.
    Range other = range_quotient(range_minus(C), range_sum(B, root));
    if (root.lo <= real(0.0)) {
      other = range_hull(range_hull(other, range_quotient(range_minus(C), B)), point_range(real(0.0)));
    }
    s = range_intersection(s, other);
  }
  return range_grown(s, RANGE_SLACK * range_magnitude(s));
}

// The ranges over a sub-triangle of what s_i and its derivatives are made of; names as in sphere_root and height_limit.
struct HeightRange {
  Corners x;   // the base point seen from the vertex
  Corners D;
  vec3 N;
  vec3 turn;   // the axis about which the angle of the curvature's blend grows
  Range c;     // curvature
  Range rate;  // derivative of c by the angle
  Range xx;
  Range xD;
  Range DD;
  Range DN;
  Range A;
  Range B;
  Range discriminant;
  Range root;         // square root of the discriminant
  Range s;            // the root of A s^2 + 2 B s + C
  Range limit_slope;  // the limit over |x|
  Range limit;
  Range held;         // s_i: the root, held within the limit
};

// For the sub-triangle with corners T of the base triangle and directions D there, whose squares have the range DD.
HeightRange height_range(Triangle tri, int i, Corners T, Corners D, Range DD) {
  vec3 P = vec3(tri.Position[i]);
  vec4 data = tri.VertexData[i];
  HeightRange h;
  h.x.a = T.a - P;
  h.x.b = T.b - P;
  h.x.c = T.c - P;
  h.x.error = T.error;
  h.D = D;
  h.N = vec3(tri.Normal[i]);
  h.turn = i == 1 ? vec3(tri.TriNormal) : -vec3(tri.TriNormal);
  Range blend = blend_range(h.x, vec3(tri.Position[i == 2 ? 1 : 2]) - P, -h.turn, data);
  real change = data.x - data.y;
  h.c = range_grown(range_sum(point_range(data.y), range_product(blend, point_range(change))),
                    RANGE_SLACK * (abs(data.x) + abs(data.y)));
  h.rate = range_grown(point_range(change / data.z), FOR_PROOF(RANGE_SLACK * abs(change / data.z)));
  if (blend.lo <= LEAST_BLEND || blend.hi >= MOST_BLEND) h.rate = range_hull(h.rate, point_range(real(0.0)));
  // Across the line behind the vertex c jumps.
  if (blend.lo <= LEAST_BLEND && blend.hi >= MOST_BLEND) h.rate = unbounded_range();
  // A square is not negative. The proofs do without that: it would tighten the balls of patches by some digits, and where
  // the bisection's chords begin, which are theirs.
  Range xx = product_range(h.x, h.x);
  h.xx = between(BY_PRECISION(max(xx.lo, real(0.0)), xx.lo), max(xx.hi, real(0.0)));
  h.xD = product_range(h.x, D);
  h.DD = DD;
  h.DN = linear_range(D, h.N);
  h.A = range_product(h.c, DD);
  h.B = range_sum(range_product(h.c, h.xD), h.DN);
  Range C = range_sum(range_product(h.c, h.xx), range_scaled(linear_range(h.x, h.N), real(2.0)));
  Range AC = range_product(h.A, C);
  Range BB = range_square(h.B);
  h.discriminant = range_grown(range_sum(BB, range_minus(AC)), RANGE_SLACK * (BB.hi + range_magnitude(AC)));
  h.root = range_root(h.discriminant);
  h.s = root_range(h.A, h.B, C, h.root);
  // height_limit.
  Range size = range_root(between(max(DD.lo, LEAST_DIRECTION_SQUARE), max(DD.hi, LEAST_DIRECTION_SQUARE)));
  Range sine = range_clamp(range_quotient(h.DN, range_scaled(size, FLAT_SINE)), real(0.0), real(1.0));
  h.limit_slope = range_quotient(sine, size);
  Range away = range_root(h.xx);
  // Nothing is negative here: the slack covers both products.
  h.limit = between(h.limit_slope.lo * away.lo * (real(1.0) - RANGE_SLACK),
                    h.limit_slope.hi * away.hi * (real(1.0) + RANGE_SLACK));
  h.held = between(h.s.lo > real(0.0) ? min(h.s.lo, h.limit.lo) : max(h.s.lo, -h.limit.hi),
                   h.s.hi > real(0.0) ? min(h.s.hi, h.limit.hi) : max(h.s.hi, -h.limit.lo));
  return h;
}

// Range of the limit's derivative as T moves by dT and D by dD. The limit is |x| times limit_slope, which is 1 / |D|,
// (D.N) / |D|^2 / FLAT_SINE, or 0 (height_limit).
Range limit_change(HeightRange h, vec3 dT, vec3 dD) {
  Range far = range_root(h.xx);
  real step = length3(dT);
  step += FOR_PROOF(RANGE_SLACK * step);
  Range away = between(-step, step);
  if (far.lo > real(0.0)) away = range_intersection(away, range_quotient(linear_range(h.x, dT), far));
  Range turned = range_product(h.limit_slope, range_quotient(linear_range(h.D, dD), h.DD));
  Range sine = range_quotient(h.DN, range_scaled(range_root(h.DD), FLAT_SINE));
  Range slope_change = between(UNBOUNDED, -UNBOUNDED);
  if (sine.hi >= real(1.0)) slope_change = range_minus(turned);
  if (sine.lo <= real(0.0)) slope_change = range_hull(slope_change, point_range(real(0.0)));
  if (sine.lo < real(1.0) && sine.hi > real(0.0)) {
    Range of_sine = range_quotient(dot_range(dD, h.N), range_scaled(h.DD, FLAT_SINE));
    slope_change = range_hull(slope_change, range_sum(of_sine, range_scaled(range_minus(turned), real(2.0))));
  }
  return range_sum(range_product(away, h.limit_slope), range_product(slope_change, far));
}

// Range of s_i's derivative as T moves by dT and D by dD (sphere_gradient).
Range height_change(HeightRange h, vec3 dT, vec3 dD) {
  Range change = between(UNBOUNDED, -UNBOUNDED);
  if (range_magnitude(h.s) >= h.limit.lo) {
    Range of_limit = limit_change(h, dT, dD);
    if (h.s.hi > real(0.0)) change = of_limit;
    if (h.s.lo < real(0.0)) change = range_hull(change, range_minus(of_limit));
    if (h.s.lo > h.limit.hi || h.s.hi < -h.limit.hi) return change;
  }
  Range s = h.held;
  Range xd = linear_range(h.x, dD);
  Range Dd = linear_range(h.D, dD);
  // The change of c times |x|^2.
  Range turning = range_product(linear_range(h.x, cross3(dT, h.turn)), h.rate);
  real slack = RANGE_SLACK * (length3(dT) + range_magnitude(s) * length3(dD));
  if (h.discriminant.hi <= real(0.0)) {
    // No line meets the sphere: s A = -B.
    Range size = h.A;
    if (!(h.A.lo > real(0.0))) size = range_minus(h.A);
    if (!(size.lo > real(0.0) && h.xx.lo > real(0.0))) return unbounded_range();
    Range pD = range_sum(h.xD, range_product(s, h.DD));
    Range along = range_sum(range_sum(linear_range(h.D, dT), xd), range_scaled(range_product(s, Dd), real(2.0)));
    Range rise = range_sum(range_sum(range_product(turning, range_quotient(pD, h.xx)), dot_range(h.N, dD)),
                           range_product(h.c, along));
    Range fall = rise;
    if (h.A.lo > real(0.0)) fall = range_minus(rise);
    return range_hull(change, range_quotient(range_grown(fall, slack), size));
  }
  if (!(h.root.lo > real(0.0))) return unbounded_range();
  // |p|^2 / |x|^2 with p = x + s D is at most 4, as |s D| is held to |x|.
  Range ss = range_square(s);
  Range pp = range_sum(range_sum(h.xx, range_scaled(range_product(s, h.xD), real(2.0))), range_product(ss, h.DD));
  pp = between(max(pp.lo, real(0.0)), max(pp.hi, real(0.0)));
  Range farther = between(real(0.0), real(4.0));
  if (h.xx.lo > real(0.0)) farther = range_intersection(farther, range_quotient(pp, h.xx));
  Range p_change = range_sum(range_sum(linear_range(h.x, dT), range_product(s, range_sum(xd, linear_range(h.D, dT)))),
                             range_product(ss, Dd));
  Range rise = range_sum(range_sum(range_sum(range_scaled(range_product(turning, farther), real(0.5)),
                                             range_product(h.c, p_change)),
                                   dot_range(h.N, dT)),
                         range_product(s, dot_range(h.N, dD)));
  return range_hull(change, range_quotient(range_grown(range_minus(rise), slack), h.root));
}

// Adds w_i s_i to sigma. w: the range of the weight i; T moves by Tu and Tv along u and v, D by Du and Dv.
void add_height(INOUT(SphereRange) sigma, int i, HeightRange h, Range w, vec3 Tu, vec3 Tv, vec3 Du, vec3 Dv) {
  sigma.s = range_sum(sigma.s, range_product(w, h.held));
  sigma.u = range_sum(sigma.u, range_product(w, height_change(h, Tu, Du)));
  sigma.v = range_sum(sigma.v, range_product(w, height_change(h, Tv, Dv)));
  // The weights' own derivatives: -1 of weight 0, 1 of weight 1 or 2.
  if (i == 0) {
    sigma.u = range_sum(sigma.u, range_minus(h.held));
    sigma.v = range_sum(sigma.v, range_minus(h.held));
  }
  if (i == 1) sigma.u = range_sum(sigma.u, h.held);
  if (i == 2) sigma.v = range_sum(sigma.v, h.held);
}
