// What the bounds of a subpatch prove about a ray, in the ray's frame, where the ray is the line x = y = 0. The surface
// stays within position_error of the cubic Bezier triangle T + q D, its tangents within tangent_error of that one's: the
// control points tell whether the ray can meet it at all, their differences whether it can meet it twice.

real cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

real length2(vec2 a) { return sqrt(a.x * a.x + a.y * a.y); }

real largest(vec2 a) { return max(abs(a.x), abs(a.y)); }

// A subpatch is searched as the root of a quadtree of sub-triangles. A path numbers the nodes of the tree: WHOLE is the
// root, 4 p + k is child k of node p. SMALLEST is the first path of the ninth and last level.
const uint WHOLE = 1u;
const uint SMALLEST = 1u << 18;

// The sub-triangle of the node with this path; xyz, w: origin and size of the subpatch.
SubTriangle sub_triangle_at(vec4 subpatch, uint path) {
  SubTriangle node;
  node.origin = vec3(subpatch);
  node.size = subpatch.w;
  int level = 0;
  while (path >> (2 * level) != WHOLE) ++level;
  for (int k = level - 1; k >= 0; --k) node = child(node, (path >> (2 * k)) & 3u);
  return node;
}

// Adds to the quadratic the linear function that is `e` at weights c and has this gradient by the weights 1 and 2.
void add_linear(INOUT(Fit) fit, vec3 c, real e, vec2 gradient) {
  // The linear function at the vertices; an edge's Bernstein coefficient is the mean of its two.
  real at0 = e - gradient.x * c.y - gradient.y * c.z;
  real at1 = at0 + gradient.x;
  real at2 = at0 + gradient.y;
  fit.corner += vec3(at0, at1, at2);
  fit.edge += vec3(at0 + at1, at1 + at2, at0 + at2) * real(0.5);
}

// Relative to the largest of the numbers compared: a component of a control point takes 11 roundings from the framed
// patch on, the product and the difference with a direction 3 more, and the tolerance 2, so this must be at least
// gamma(16). Which nodes are certified depends on it, and with them a root's last digits.
const real HULL_ROUNDINGS = real(1e-6);

// Whether the surface stays on one side of the ray, farther from it than `tolerance`, seen in the plane along the
// direction a: the control points, whose hull contains the cubic, do.
bool separated_along(ControlNet net, vec2 a, real tolerance) {
  real c0 = cross2(net.b300, a);
  real c1 = cross2(net.b030, a);
  real c2 = cross2(net.b003, a);
  real c3 = cross2(net.b210, a);
  real c4 = cross2(net.b120, a);
  real c5 = cross2(net.b021, a);
  real c6 = cross2(net.b012, a);
  real c7 = cross2(net.b102, a);
  real c8 = cross2(net.b201, a);
  real c9 = cross2(net.b111, a);
  real low = smaller_of(smaller_of(smaller_of(smaller_of(c0, c1), smaller_of(c2, c3)),
                                   smaller_of(smaller_of(c4, c5), smaller_of(c6, c7))),
                        smaller_of(c8, c9));
  real high = larger_of(larger_of(larger_of(larger_of(c0, c1), larger_of(c2, c3)),
                                  larger_of(larger_of(c4, c5), larger_of(c6, c7))),
                        larger_of(c8, c9));
  // |a x b| <= (|a.x| + |a.y|) tolerance for a b whose components are at most the tolerance; and rounding.
  real most = tolerance * (abs(a.x) + abs(a.y)) + HULL_ROUNDINGS * max(abs(low), abs(high));
  return low > most || high < -most;
}

// False if the ray passes the surface at more than `tolerance`: then one of four directions separates them, those of the
// triangle's three edges and the one at right angles to the sum of two. True proves nothing.
bool hull_overlaps_ray(ControlNet net, real tolerance) {
  vec2 a = net.b030 - net.b300;
  vec2 b = net.b003 - net.b300;
  return !(separated_along(net, a, tolerance) || separated_along(net, b, tolerance) ||
           separated_along(net, b - a, tolerance) ||
           separated_along(net, vec2(-a.y - b.y, a.x + b.x), tolerance));
}

// The contraction test. Let f(l) = S.xy with l the weights 1 and 2 within a sub-triangle, J = 3 (u, v) its Jacobian and
// J0 = 3 (mean.u, mean.v) a constant matrix. If |1 - J0^-1 J| <= k < 1 for all J that occur, in the matrix norm of the
// maximum norm, then l - J0^-1 f(l) is a contraction of the (convex) sub-triangle: two points p, q have
// f(q) - f(p) = J' (q - p), J' the mean of J between them, and such a mean satisfies the same inequality. So f has at most
// one zero there. This is the condition of the Krawczyk test (Krawczyk 1969, "Newton-Algorithmen zur Bestimmung von
// Nullstellen mit Fehlerschranken"; Moore, Kearfott & Cloud 2009, "Introduction to Interval Analysis", chapter 8), which
// Toth (1985, "On ray tracing parametric surfaces") brought to ray tracing. Two things differ here. The matrices J are
// enclosed by the hull of six pairs of control vectors, not by an interval for each of the four elements, which keeps
// what S_u and S_v have in common. And nothing is proven about the existence of a root: Newton's method finds it or not.

// J0^-1 a, times 3.
vec2 weights_for(MeanJacobian mean, vec2 a) { return vec2(cross2(a, mean.v), cross2(mean.u, a)) / mean.area; }

// |1 - J0^-1 J| for J = 3 (u, v), in the matrix norm of the maximum norm: the largest sum of a row's magnitudes.
real contraction_of(MeanJacobian mean, vec2 u, vec2 v) {
  vec2 column_u = weights_for(mean, u);
  vec2 column_v = weights_for(mean, v);
  return max(abs(real(1.0) - column_u.x) + abs(column_v.x), abs(column_u.y) + abs(real(1.0) - column_v.y));
}

real longest_component(Tangents t) {
  vec2 u = max(max(max(abs(t.u0), abs(t.u1)), max(abs(t.u2), abs(t.u3))), max(abs(t.u4), abs(t.u5)));
  vec2 v = max(max(max(abs(t.v0), abs(t.v1)), max(abs(t.v2), abs(t.v3))), max(abs(t.v4), abs(t.v5)));
  return max(max(u.x, u.y), max(v.x, v.y));
}

// J0, the mean of the six pairs of control vectors, and the bound k of the contraction test. At each point S_u / 3 and
// S_v / 3 of the net are the same convex combination of the u_i and of the v_i, and a norm is convex, so the largest k of
// the six pairs is one for all points; S_u / 3 and S_v / 3 of the surface differ from the net's by no more than
// tangent_error. k is at least 1, or NaN, where nothing is proven.
MeanJacobian mean_jacobian(Tangents t, real tangent_error) {
  const real sixth = real(1.0) / real(6.0);
  EXACT MeanJacobian mean;
  mean.u = (t.u0 + t.u1 + (t.u2 + t.u3) + (t.u4 + t.u5)) * sixth;
  mean.v = (t.v0 + t.v1 + (t.v2 + t.v3) + (t.v4 + t.v5)) * sixth;
  mean.area = cross2(mean.u, mean.v);
  EXACT real of_net = max(max(max(contraction_of(mean, t.u0, t.v0), contraction_of(mean, t.u1, t.v1)),
                              max(contraction_of(mean, t.u2, t.v2), contraction_of(mean, t.u3, t.v3))),
                          max(contraction_of(mean, t.u4, t.v4), contraction_of(mean, t.u5, t.v5)));
  // A change of u or v by the vector e changes an element of J0^-1 J by |a x e| / |area| <= |a| |e| / |area|, a a column
  // of J0 and |a| at most sqrt(2) times its largest component; a row has two elements. And rounding.
  EXACT real longest = longest_component(t);
  mean.contraction_bound =
      of_net + (real(2.83) * tangent_error * longest + HULL_ROUNDINGS * longest * longest) / abs(mean.area);
  return mean;
}

// Whether the sub-triangle, for which k = mean.contraction_bound < 1, holds no root, given f = S.xy at the weights l
// within it. For a root r there the contraction gives |r - l + J0^-1 f| <= k |r - l|, hence
// |r - l + J0^-1 f| <= k / (1 - k) |J0^-1 f|, as in the theorem of Newton and Kantorovich: if no point so near
// l - J0^-1 f lies in the sub-triangle, there is none. `margin`: of the weights, for rounding.
bool newton_excludes(MeanJacobian mean, vec2 f, vec3 l, real margin) {
  vec2 step = weights_for(mean, f) * (real(1.0) / real(3.0));
  real off = mean.contraction_bound / (real(1.0) - mean.contraction_bound) * largest(step);
  return l.y - step.x + off < -margin || l.z - step.y + off < -margin ||
         l.x + step.x + step.y + real(2.0) * off < -margin;
}
