// The cage of a patch: the cubic Bezier triangle T + q D, q a quadratic that stays within a known distance of
// sigma. Its control points bound the surface, those of its derivatives tell whether a ray can meet it twice.

real cross2(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

real length2(vec2 a) { return sqrt(a.x * a.x + a.y * a.y); }

real largest(vec2 a) { return max(abs(a.x), abs(a.y)); }

// From a node's origin to that of its child k.
vec3 child_shift(uint k, real half_size) {
  if (k == 3u) return vec3(half_size);
  return vec3(k == 0u ? half_size : real(0.0), k == 1u ? half_size : real(0.0),
              k == 2u ? half_size : real(0.0));
}

// The part of the patch that a corner's child, k = 0, 1, 2, or the middle one, k = 3, covers.
Node child(Node node, uint k) {
  real half_size = real(0.5) * node.size;
  Node part;
  part.origin = node.origin + child_shift(k, half_size);
  part.size = k == 3u ? -half_size : half_size;
  return part;
}

// The node whose child k this is.
Node parent(Node part, uint k) {
  real half_size = k == 3u ? -part.size : part.size;
  Node node;
  node.origin = part.origin - child_shift(k, half_size);
  node.size = real(2.0) * half_size;
  return node;
}

// The path to a part itself, and to the first of its smallest nodes.
const uint WHOLE = 1u;
const uint SMALLEST = 1u << 18;

// The node of a part, origin + size l of its patch, to which a path leads.
Node node_at(vec4 part, uint path) {
  Node node;
  node.origin = vec3(part);
  node.size = part.w;
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

// Control points of T + q D over a node.
Net cage_net(FramedPatch framed, vec3 corner, vec3 edge, Node node) {
  vec3 a = node.origin + vec3(node.size, 0.0, 0.0);
  vec3 b = node.origin + vec3(0.0, node.size, 0.0);
  vec3 c = node.origin + vec3(0.0, 0.0, node.size);
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
  EXACT Net net;
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

// The box of the control points holds the cage: whether it comes within `reach` of the ray.
bool near_ray(Net net, real reach) {
  vec2 low = min(min(min(min(net.b300, net.b030), min(net.b003, net.b210)),
                     min(min(net.b120, net.b021), min(net.b012, net.b102))),
                 min(net.b201, net.b111));
  vec2 high = max(max(max(max(net.b300, net.b030), max(net.b003, net.b210)),
                      max(max(net.b120, net.b021), max(net.b012, net.b102))),
                  max(net.b201, net.b111));
  return low.x <= reach && low.y <= reach && high.x >= -reach && high.y >= -reach;
}

Tangents tangents(Net net) {
  Tangents t;
  t.u0 = net.b210 - net.b300;
  t.u1 = net.b030 - net.b120;
  t.u2 = net.b012 - net.b102;
  t.u3 = net.b120 - net.b210;
  t.u4 = net.b021 - net.b111;
  t.u5 = net.b111 - net.b201;
  t.v0 = net.b201 - net.b300;
  t.v1 = net.b021 - net.b120;
  t.v2 = net.b003 - net.b102;
  t.v3 = net.b111 - net.b210;
  t.v4 = net.b012 - net.b111;
  t.v5 = net.b102 - net.b201;
  return t;
}

// Range of cross(a, t.v) over t's six control vectors; and of cross(t.u, a).
Range across_v(vec2 a, Tangents t) {
  real c0 = cross2(a, t.v0);
  real c1 = cross2(a, t.v1);
  real c2 = cross2(a, t.v2);
  real c3 = cross2(a, t.v3);
  real c4 = cross2(a, t.v4);
  real c5 = cross2(a, t.v5);
  Range range;
  range.low = min(min(min(c0, c1), min(c2, c3)), min(c4, c5));
  range.high = max(max(max(c0, c1), max(c2, c3)), max(c4, c5));
  return range;
}

Range across_u(vec2 a, Tangents t) {
  real c0 = cross2(t.u0, a);
  real c1 = cross2(t.u1, a);
  real c2 = cross2(t.u2, a);
  real c3 = cross2(t.u3, a);
  real c4 = cross2(t.u4, a);
  real c5 = cross2(t.u5, a);
  Range range;
  range.low = min(min(min(c0, c1), min(c2, c3)), min(c4, c5));
  range.high = max(max(max(c0, c1), max(c2, c3)), max(c4, c5));
  return range;
}

Range hull_of(Range a, Range b) {
  Range range;
  range.low = min(a.low, b.low);
  range.high = max(a.high, b.high);
  return range;
}

real longest_component(Tangents t) {
  vec2 u = max(max(max(abs(t.u0), abs(t.u1)), max(abs(t.u2), abs(t.u3))), max(abs(t.u4), abs(t.u5)));
  vec2 v = max(max(max(abs(t.v0), abs(t.v1)), max(abs(t.v2), abs(t.v3))), max(abs(t.v4), abs(t.v5)));
  return max(max(u.x, u.y), max(v.x, v.y));
}

// Bounds cross(S_u(p), S_v(q)) / 9 for all points p, q of a node, `stray` the most by which S_u / 3 and S_v / 3
// differ from the cage's. If 0 is not among them no line along z meets the node twice: for two points of it,
// S(q) - S(p) = (q_u - p_u) U + (q_v - p_v) V with U and V means of S_u and S_v, which lie in the hulls
// of the control vectors, and U, V are independent.
Range jacobian(Tangents t, real stray) {
  Range range = hull_of(hull_of(hull_of(across_v(t.u0, t), across_v(t.u1, t)),
                                hull_of(across_v(t.u2, t), across_v(t.u3, t))),
                        hull_of(across_v(t.u4, t), across_v(t.u5, t)));
  // |a x b| <= |a| |b|, the lengths at most sqrt(2) times their largest component; and rounding.
  real longest = longest_component(t);
  real slack = stray * (real(2.83) * longest + stray) + real(1e-6) * longest * longest;
  range.low -= slack;
  range.high += slack;
  return range;
}

// How far a weight can grow at most on the way to the root: the numerator of Cramer's rule, at most `most`, over
// a positive determinant between `smallest` and `biggest`.
real growth(real most, real smallest, real biggest) {
  return most / (real(3.0) * (most > real(0.0) ? smallest : biggest));
}

// Whether the root cannot be in the node, given a point of it with weights l within it and S = f there:
// interval Newton, the weights of the root are l - M^-1 f, M = (U, V) as above. `margin`: weights.
bool excludes(Tangents t, Range det, real stray, vec2 f, vec3 l, real margin) {
  // Over all U and V; over det they are the change of weight 1, -cross(f, V), of weight 2, -cross(U, f), and of
  // weight 0, cross(f, V - U), minus the two.
  Range fv = across_v(f, t);
  Range uf = across_u(f, t);
  real w0 = cross2(f, t.v0 - t.u0);
  real w1 = cross2(f, t.v1 - t.u1);
  real w2 = cross2(f, t.v2 - t.u2);
  real w3 = cross2(f, t.v3 - t.u3);
  real w4 = cross2(f, t.v4 - t.u4);
  real w5 = cross2(f, t.v5 - t.u5);
  real slack = real(2.0) * stray * length2(f);
  bool positive = det.low > real(0.0);
  real smallest = positive ? det.low : -det.high;
  real biggest = positive ? det.high : -det.low;
  real most0 = positive ? max(max(max(w0, w1), max(w2, w3)), max(w4, w5))
                        : -min(min(min(w0, w1), min(w2, w3)), min(w4, w5));
  real most1 = positive ? -fv.low : fv.high;
  real most2 = positive ? -uf.low : uf.high;
  return l.x + growth(most0 + slack, smallest, biggest) < -margin ||
         l.y + growth(most1 + slack, smallest, biggest) < -margin ||
         l.z + growth(most2 + slack, smallest, biggest) < -margin;
}
