// Ranges of the sphere surface's displacement sigma = sum w_i s_i (surface.glsl) and of its derivatives over a sub-triangle
// of a patch, by interval arithmetic on the closed form. The kernels bound subpatches with them that no quadratic follows:
// where what a height depends on changes fast, about points at which directions nearly vanish. The host proves with the same
// text, in double precision, where subpatches are smooth and how far they are displaced (app/surface/sphere_range.h).
//
// Sigma is Lipschitz where the directions do not vanish. Between two points it therefore changes by a mean of elements of
// its generalised gradient (Clarke 1983, "Optimization and Nonsmooth Analysis", theorem 2.3.7) along the segment, and a
// range that holds the derivatives on both sides of a curve on which they jump bounds the change across it.
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

// Ranges of held_square, which grows with both, and of how far it is above d.
Range held_square_range(Range d, Range least) {
  real lo = held_square(d.lo, least.lo);
  real hi = held_square(d.hi, least.hi);
  return between(lo * (real(1.0) - RANGE_SLACK), hi * (real(1.0) + RANGE_SLACK));
}

real held_up(real d, real least) {
  real short_of = max(least - d, real(0.0));
  return d < real(0.0) ? real(0.5) * least - d : real(0.5) * short_of * short_of / least;
}

Range held_up_range(Range d, Range least) {
  real lo = held_up(d.hi, least.lo);
  real hi = held_up(d.lo, least.hi);
  return between(lo * (real(1.0) - RANGE_SLACK), hi * (real(1.0) + RANGE_SLACK));
}

// Ranges of held_inverse, which is largest, 256 / 243, at 8 / 9, and of its slope, which has its extremes at 4 / 9 and 1.
Range held_inverse_range(Range z) {
  real a = held_inverse(z.lo);
  real b = held_inverse(z.hi);
  Range inverse = between(min(a, b), max(a, b));
  if (z.lo < real(0.89) && z.hi > real(0.88)) inverse.hi = real(1.0535);
  return range_grown(inverse, RANGE_SLACK * inverse.hi);
}

Range held_inverse_slope_range(Range z) {
  real a = held_inverse_slope(z.lo);
  real b = held_inverse_slope(z.hi);
  Range slope = between(min(a, b), max(a, b));
  if (z.lo < real(0.45) && z.hi > real(0.44)) slope.hi = real(1.7778);
  if (z.lo <= real(1.0) && z.hi >= real(1.0)) slope.lo = real(-1.0);
  return range_grown(slope, real(8.0) * RANGE_SLACK);
}

// The ranges over a sub-triangle of what s_i and its derivatives are made of; names as in SphereLine.
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
  Range A;
  Range B;
  Range C;
  Range square;
  Range least;   // the least of the square in the definition
  Range slope;
  Range ratio;   // of B + slope and its least in the definition
  Range lifted;  // what the square is held up by, over |D|^2
  Range nearer;  // by_curvature
  bool regular;  // all over the sub-triangle
  Range s;
  Range highest;
  Range height;  // s_i
  bool free;     // s_i is s all over the sub-triangle
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
  h.A = range_product(h.c, DD);
  h.B = range_sum(range_product(h.c, h.xD), linear_range(D, h.N));
  h.C = range_sum(range_product(h.c, h.xx), range_scaled(linear_range(h.x, h.N), real(2.0)));
  Range AC = range_product(h.A, h.C);
  Range BB = range_square(h.B);
  h.square = range_grown(range_sum(BB, range_minus(AC)), RANGE_SLACK * (BB.hi + range_magnitude(AC)));
  Range positive_DD = between(max(DD.lo, LEAST_DIRECTION_SQUARE), max(DD.hi, LEAST_DIRECTION_SQUARE));
  Range size = range_root(positive_DD);
  h.least = range_scaled(positive_DD, LEAST_SLOPE * LEAST_SLOPE);
  h.slope = range_root(held_square_range(h.square, h.least));
  Range sum = range_sum(h.B, h.slope);
  Range least_sum = range_scaled(size, real(2.0) * LEAST_SLOPE);
  h.ratio = range_quotient(sum, least_sum);
  h.regular = h.square.lo >= h.least.hi && h.ratio.lo >= real(1.0);
  if (h.regular) {
    h.lifted = point_range(real(0.0));
    h.nearer = point_range(real(0.0));
    h.s = range_quotient(range_minus(h.C), sum);
    // The same, (slope - B) / A, where it is closer.
    Range over_A = range_sum(h.slope, range_minus(h.B));
    if (h.A.lo > real(0.0)) h.s = range_intersection(h.s, range_quotient(over_A, h.A));
    if (h.A.hi < real(0.0)) h.s = range_intersection(h.s, range_quotient(range_minus(over_A), range_minus(h.A)));
  } else {
    h.lifted = range_quotient(held_up_range(h.square, h.least), positive_DD);
    h.nearer = range_quotient(range_product(h.c, h.xx),
                              range_sum(range_product(range_square(h.c), h.xx), point_range(CURVED * CURVED)));
    Range rise = range_sum(range_product(h.lifted, h.nearer), range_minus(h.C));
    h.s = range_quotient(range_product(rise, held_inverse_range(h.ratio)), least_sum);
  }
  h.s = range_grown(h.s, RANGE_SLACK * range_magnitude(h.s));
  Range highest = range_scaled(range_quotient(range_root(h.xx), size), HIGHEST);
  h.highest = between(max(highest.lo, real(0.0)) * (real(1.0) - RANGE_SLACK), highest.hi * (real(1.0) + RANGE_SLACK));
  h.free = range_magnitude(h.s) <= FREE * h.highest.lo;
  h.height = h.s;
  if (!h.free) {
    real lo = held_height(h.s.lo, h.s.lo > real(0.0) ? h.highest.lo : h.highest.hi);
    real hi = held_height(h.s.hi, h.s.hi > real(0.0) ? h.highest.hi : h.highest.lo);
    h.height = between(lo - RANGE_SLACK * abs(lo), hi + RANGE_SLACK * abs(hi));
  }
  return h;
}

// Range of the derivative of s where the definition may not hold, as T moves by dT and D by dD (irregular_gradient).
Range irregular_change(HeightRange h, vec3 dT, vec3 dD) {
  if (!(h.xx.lo > real(0.0))) return unbounded_range();
  Range xd = linear_range(h.x, dD);
  Range Dd = linear_range(h.D, dD);
  Range xt = linear_range(h.x, dT);
  Range Dt = linear_range(h.D, dT);
  Range Nd = dot_range(h.N, dD);
  Range dc = range_quotient(range_product(linear_range(h.x, cross3(dT, h.turn)), h.rate), h.xx);
  Range dA = range_sum(range_product(dc, h.DD), range_scaled(range_product(h.c, Dd), real(2.0)));
  Range dB = range_sum(range_sum(range_product(dc, h.xD), range_product(h.c, range_sum(Dt, xd))), Nd);
  Range dC = range_sum(range_product(dc, h.xx),
                       range_scaled(range_sum(range_product(h.c, xt), dot_range(h.N, dT)), real(2.0)));
  Range d_square = range_sum(range_scaled(range_product(h.B, dB), real(2.0)),
                             range_minus(range_sum(range_product(h.A, dC), range_product(h.C, dA))));
  Range kept = range_clamp(range_quotient(h.square, h.least), real(0.0), real(1.0));
  Range lost = range_sum(point_range(real(1.0)), range_minus(range_square(kept)));
  lost = between(max(lost.lo, real(0.0)), lost.hi);
  Range of_least = range_product(lost, range_scaled(Dd, LEAST_SLOPE * LEAST_SLOPE));
  Range d_held = range_sum(range_product(d_square, kept), of_least);
  Range lost_square = range_sum(kept, point_range(real(-1.0)));
  Range Dd_DD = range_quotient(Dd, h.DD);
  // The held square less the square, over |D|^2.
  Range d_lifted = range_sum(range_quotient(range_sum(range_product(d_square, lost_square), of_least), h.DD),
                             range_minus(range_scaled(range_product(h.lifted, Dd_DD), real(2.0))));
  Range least_sum = range_scaled(range_root(h.DD), real(2.0) * LEAST_SLOPE);
  Range d_sum = range_sum(dB, range_quotient(range_scaled(d_held, real(0.5)), h.slope));
  Range d_ratio = range_sum(range_quotient(d_sum, least_sum), range_minus(range_product(h.ratio, Dd_DD)));
  Range cc_xx = range_product(range_square(h.c), h.xx);
  Range q = range_sum(cc_xx, point_range(CURVED * CURVED));
  Range qq = range_square(q);
  Range d_nearer = range_sum(range_product(range_product(dc, h.xx),
                                           range_quotient(range_sum(point_range(CURVED * CURVED), range_minus(cc_xx)), qq)),
                             range_product(range_scaled(range_product(h.c, xt), real(2.0) * CURVED * CURVED),
                                           range_quotient(point_range(real(1.0)), qq)));
  Range rise = range_sum(range_product(h.lifted, h.nearer), range_minus(h.C));
  Range d_rise = range_sum(range_sum(range_product(d_lifted, h.nearer), range_product(h.lifted, d_nearer)),
                           range_minus(dC));
  Range change = range_sum(range_product(d_rise, held_inverse_range(h.ratio)),
                           range_product(rise, range_product(held_inverse_slope_range(h.ratio), d_ratio)));
  return range_sum(range_quotient(change, least_sum), range_minus(range_product(h.s, Dd_DD)));
}

// Range of the derivative of s as T moves by dT and D by dD.
Range line_change(HeightRange h, vec3 dT, vec3 dD) {
  if (!h.regular) return irregular_change(h, dT, dD);
  Range s = h.s;
  Range xd = linear_range(h.x, dD);
  Range Dd = linear_range(h.D, dD);
  // The change of c times |x|^2.
  Range turning = range_product(linear_range(h.x, cross3(dT, h.turn)), h.rate);
  real slack = RANGE_SLACK * (length3(dT) + range_magnitude(s) * length3(dD));
  Range ss = range_square(s);
  Range pp = range_sum(range_sum(h.xx, range_scaled(range_product(s, h.xD), real(2.0))), range_product(ss, h.DD));
  pp = between(max(pp.lo, real(0.0)), max(pp.hi, real(0.0)));
  // |p|^2 / |x|^2 with p = x + s D; where s is not held altogether |s D| is at most 25/12 of |x|.
  Range farther = between(real(0.0), real(9.6));
  if (h.xx.lo > real(0.0)) farther = range_intersection(farther, range_quotient(pp, h.xx));
  Range p_change = range_sum(range_sum(linear_range(h.x, dT), range_product(s, range_sum(xd, linear_range(h.D, dT)))),
                             range_product(ss, Dd));
  Range rise = range_sum(range_sum(range_sum(range_scaled(range_product(turning, farther), real(0.5)),
                                             range_product(h.c, p_change)),
                                   dot_range(h.N, dT)),
                         range_product(s, dot_range(h.N, dD)));
  return range_quotient(range_grown(range_minus(rise), slack), h.slope);
}

// Range of s_i's derivative as T moves by dT and D by dD (sphere_gradient).
Range height_change(HeightRange h, vec3 dT, vec3 dD) {
  if (h.free) return line_change(h, dT, dD);
  // Of the derivative of s it has 2 left, and 1 - left (2 HELD - left) of that of `highest`, where left falls from 1 / 2, where
  // s begins to be held, to 0 (sphere_gradient).
  real least = max(max(h.s.lo, -h.s.hi), real(0.0));
  real most = range_magnitude(h.s);
  real freest = h.highest.hi > real(0.0) ? clamp(HELD - least / h.highest.hi, real(0.0), real(0.5)) : real(0.5);
  real tightest = h.highest.lo > real(0.0) ? clamp(HELD - most / h.highest.lo, real(0.0), real(0.5)) : real(0.0);
  Range size = range_root(h.DD);
  real step = length3(dT) * (real(1.0) + RANGE_SLACK);
  Range far = range_root(h.xx);
  Range away = between(-step, step);
  if (far.lo > real(0.0)) away = range_intersection(away, range_quotient(linear_range(h.x, dT), far));
  Range turned = range_product(range_quotient(linear_range(h.D, dD), h.DD), far);
  Range d_highest = range_scaled(range_quotient(range_sum(away, range_minus(turned)), size), HIGHEST);
  Range of_highest = between(real(1.0) - freest * (real(2.0) * HELD - freest),
                             real(1.0) - tightest * (real(2.0) * HELD - tightest));
  Range change = range_product(range_grown(of_highest, real(4.0) * RANGE_SLACK), d_highest);
  if (h.s.hi <= real(0.0)) {
    change = range_minus(change);
  } else if (h.s.lo < real(0.0)) {
    change = range_hull(change, range_minus(change));
  }
  if (freest <= real(0.0)) return change;
  // What is held altogether does not count.
  real counts = HELD * h.highest.hi;
  h.s = between(max(h.s.lo, -counts), min(h.s.hi, counts));
  Range part = range_grown(between(real(2.0) * tightest, real(2.0) * freest), real(4.0) * RANGE_SLACK);
  return range_sum(change, range_product(part, line_change(h, dT, dD)));
}

// Adds w_i s_i to sigma. w: the range of the weight i; T moves by Tu and Tv along u and v, D by Du and Dv.
void add_height(INOUT(SphereRange) sigma, int i, HeightRange h, Range w, vec3 Tu, vec3 Tv, vec3 Du, vec3 Dv) {
  sigma.s = range_sum(sigma.s, range_product(w, h.height));
  sigma.u = range_sum(sigma.u, range_product(w, height_change(h, Tu, Du)));
  sigma.v = range_sum(sigma.v, range_product(w, height_change(h, Tv, Dv)));
  // The weights' own derivatives: -1 of weight 0, 1 of weight 1 or 2.
  if (i == 0) {
    sigma.u = range_sum(sigma.u, range_minus(h.height));
    sigma.v = range_sum(sigma.v, range_minus(h.height));
  }
  if (i == 1) sigma.u = range_sum(sigma.u, h.height);
  if (i == 2) sigma.v = range_sum(sigma.v, h.height);
}
