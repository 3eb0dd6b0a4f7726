// The cage of a patch: the cubic Bezier triangle T + q D, q a quadratic that stays within a known distance of
// sigma. Its control points bound the surface, those of its derivatives tell whether a ray can meet it twice.

real cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

real length2(vec2 a) { return sqrt(a.x * a.x + a.y * a.y); }

real largest(vec2 a) { return max(abs(a.x), abs(a.y)); }

// Weights within a node of those in the triangle, and back.
vec3 weights_in(SubTriangle node, vec3 w) { return (w - node.origin) / node.size; }

vec3 weights_of(SubTriangle node, vec3 l) { return node.origin + l * node.size; }

// From a node's origin to that of its child k.
vec3 child_shift(uint k, real half_size) {
  if (k == 3u) return vec3(half_size);
  return vec3(k == 0u ? half_size : real(0.0), k == 1u ? half_size : real(0.0),
              k == 2u ? half_size : real(0.0));
}

// The part of the patch that a corner's child, k = 0, 1, 2, or the middle one, k = 3, covers.
SubTriangle child(SubTriangle node, uint k) {
  real half_size = real(0.5) * node.size;
  SubTriangle subpatch;
  subpatch.origin = node.origin + child_shift(k, half_size);
  subpatch.size = k == 3u ? -half_size : half_size;
  return subpatch;
}

// The node whose child k this is.
SubTriangle parent(SubTriangle subpatch, uint k) {
  real half_size = k == 3u ? -subpatch.size : subpatch.size;
  SubTriangle node;
  node.origin = subpatch.origin - child_shift(k, half_size);
  node.size = real(2.0) * half_size;
  return node;
}

// The path to a part itself, and to the first of its smallest nodes.
const uint WHOLE = 1u;
const uint SMALLEST = 1u << 18;

// The node of a part, origin + size l of its patch, to which a path leads.
SubTriangle sub_triangle_at(vec4 subpatch, uint path) {
  SubTriangle node;
  node.origin = vec3(subpatch);
  node.size = subpatch.w;
  int level = 0;
  while (path >> (2 * level) != WHOLE) ++level;
  for (int k = level - 1; k >= 0; --k) node = child(node, (path >> (2 * k)) & 3u);
  return node;
}

// Blossom of the quadratic q at weights a, b.
real blossom(vec3 corner, vec3 edge, vec3 a, vec3 b) {
  EXACT real q = corner.x * a.x * b.x + corner.y * a.y * b.y + corner.z * a.z * b.z +
                 edge.x * (a.x * b.y + a.y * b.x) + edge.y * (a.y * b.z + a.z * b.y) +
                 edge.z * (a.x * b.z + a.z * b.x);
  return q;
}

vec3 centre_of(SubTriangle node) { return node.origin + vec3(node.size / real(3.0)); }

// Adds the linear function that is `e` at weights c and has this gradient.
void add_linear(INOUT(Fit) fit, vec3 c, real e, vec2 gradient) {
  // At the patch's vertices.
  real at0 = e - gradient.x * c.y - gradient.y * c.z;
  real at1 = at0 + gradient.x;
  real at2 = at0 + gradient.y;
  fit.corner += vec3(at0, at1, at2);
  fit.edge += vec3(at0 + at1, at1 + at2, at0 + at2) * real(0.5);
}

// Control points of T + q D over a node.
ControlNet control_net(FramedPatch framed, vec3 corner, vec3 edge, SubTriangle node) {
  vec3 a = weights_of(node, vec3(1.0, 0.0, 0.0));
  vec3 b = weights_of(node, vec3(0.0, 1.0, 0.0));
  vec3 c = weights_of(node, vec3(0.0, 0.0, 1.0));
  vec2 P0 = vec2(framed.P0);
  vec2 P1 = vec2(framed.P1);
  vec2 P2 = vec2(framed.P2);
  vec2 D0 = vec2(framed.D0);
  vec2 D1 = vec2(framed.D1);
  vec2 D2 = vec2(framed.D2);
  vec2 Ta = P0 * a.x + P1 * a.y + P2 * a.z;
  vec2 Tb = P0 * b.x + P1 * b.y + P2 * b.z;
  vec2 Tc = P0 * c.x + P1 * c.y + P2 * c.z;
  vec2 Da = D0 * a.x + D1 * a.y + D2 * a.z;
  vec2 Db = D0 * b.x + D1 * b.y + D2 * b.z;
  vec2 Dc = D0 * c.x + D1 * c.y + D2 * c.z;
  real qaa = blossom(corner, edge, a, a);
  real qbb = blossom(corner, edge, b, b);
  real qcc = blossom(corner, edge, c, c);
  real qab = blossom(corner, edge, a, b);
  real qbc = blossom(corner, edge, b, c);
  real qca = blossom(corner, edge, c, a);
  const real third = real(1.0) / real(3.0);
  EXACT ControlNet net;
  net.b300 = Ta + Da * qaa;
  net.b030 = Tb + Db * qbb;
  net.b003 = Tc + Dc * qcc;
  net.b210 = (Ta * real(2.0) + Tb + Db * qaa + Da * (real(2.0) * qab)) * third;
  net.b120 = (Tb * real(2.0) + Ta + Da * qbb + Db * (real(2.0) * qab)) * third;
  net.b021 = (Tb * real(2.0) + Tc + Dc * qbb + Db * (real(2.0) * qbc)) * third;
  net.b012 = (Tc * real(2.0) + Tb + Db * qcc + Dc * (real(2.0) * qbc)) * third;
  net.b102 = (Tc * real(2.0) + Ta + Da * qcc + Dc * (real(2.0) * qca)) * third;
  net.b201 = (Ta * real(2.0) + Tc + Dc * qaa + Da * (real(2.0) * qca)) * third;
  net.b111 = (Ta + Tb + Tc + Da * qbc + Db * qca + Dc * qab) * third;
  return net;
}

// Whether the control points, and with them the cage, stay farther than `reach` on one side of the ray, in the
// direction across a.
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
  real low = min(min(min(min(c0, c1), min(c2, c3)), min(min(c4, c5), min(c6, c7))), min(c8, c9));
  real high = max(max(max(max(c0, c1), max(c2, c3)), max(max(c4, c5), max(c6, c7))), max(c8, c9));
  // |a x b| of the b within reach of the ray, and rounding.
  real most = tolerance * (abs(a.x) + abs(a.y)) + real(1e-6) * max(abs(low), abs(high));
  return low > most || high < -most;
}

// Whether the cage comes within `reach` of the ray, as far as its extents across the triangle's edges, and along the
// median between two of them, tell.
bool hull_overlaps_ray(ControlNet net, real tolerance) {
  vec2 a = net.b030 - net.b300;
  vec2 b = net.b003 - net.b300;
  return !(separated_along(net, a, tolerance) || separated_along(net, b, tolerance) || separated_along(net, b - a, tolerance) ||
           separated_along(net, vec2(-a.y - b.y, a.x + b.x), tolerance));
}

// J0^-1 a.
vec2 weights_for(MeanJacobian mean, vec2 a) { return vec2(cross2(a, mean.v), cross2(mean.u, a)) / mean.area; }

Tangents tangents(ControlNet net) {
  Tangents t;
  t.u0 = net.b210 - net.b300;
  t.u1 = net.b030 - net.b120;
  t.u2 = net.b012 - net.b102;
  t.u3 = net.b120 - net.b210;
  t.u4 = net.b111 - net.b201;
  t.u5 = net.b021 - net.b111;
  t.v0 = net.b201 - net.b300;
  t.v1 = net.b021 - net.b120;
  t.v2 = net.b003 - net.b102;
  t.v3 = net.b111 - net.b210;
  t.v4 = net.b102 - net.b201;
  t.v5 = net.b012 - net.b111;
  return t;
}

// By how much 1 - J0^-1 (u, v) lengthens a vector at most, lengths measured by the largest component.
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

// The mean of the control vectors, J0, and how far all J = (S_u, S_v) of the node are from it. At one point S_u and
// S_v are the same convex combination of the u_i and the v_i, but for `stray`, the most by which S_u / 3 and S_v / 3
// differ from the cage's. Where `spread` is less than 1 no line along z meets the node twice: from p to q S changes by
// J (q - p), J the mean along the way, which is no farther from J0.
MeanJacobian mean_jacobian(Tangents t, real position_error) {
  const real sixth = real(1.0) / real(6.0);
  EXACT MeanJacobian mean;
  mean.u = (t.u0 + t.u1 + (t.u2 + t.u3) + (t.u4 + t.u5)) * sixth;
  mean.v = (t.v0 + t.v1 + (t.v2 + t.v3) + (t.v4 + t.v5)) * sixth;
  mean.area = cross2(mean.u, mean.v);
  EXACT real contraction_bound = max(max(max(contraction_of(mean, t.u0, t.v0), contraction_of(mean, t.u1, t.v1)),
                              max(contraction_of(mean, t.u2, t.v2), contraction_of(mean, t.u3, t.v3))),
                          max(contraction_of(mean, t.u4, t.v4), contraction_of(mean, t.u5, t.v5)));
  // |a x b| <= |a| |b|, the lengths at most sqrt(2) times their largest component; two columns; and rounding.
  EXACT real longest = longest_component(t);
  mean.contraction_bound = contraction_bound + (real(2.83) * position_error * longest + real(1e-6) * longest * longest) / abs(mean.area);
  return mean;
}

// Whether the root cannot be in the node, given a point of it with weights l within it and S = f there: it lies at
// l - J^-1 f, which differs from l - J0^-1 f by spread / (1 - spread) of that step at most. `margin`: weights.
bool newton_excludes(MeanJacobian mean, vec2 f, vec3 l, real margin) {
  vec2 step = weights_for(mean, f) * (real(1.0) / real(3.0));
  real off = mean.contraction_bound / (real(1.0) - mean.contraction_bound) * largest(step);
  return l.y - step.x + off < -margin || l.z - step.y + off < -margin ||
         l.x + step.x + step.y + real(2.0) * off < -margin;
}
