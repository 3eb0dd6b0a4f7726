// The thesis's fields, listings 3.5 (phong) and 3.6 (sphere): at a point of space, the weights of the base
// triangle's offset copy through that point (xyz) and the signed distance to the surface along the shell
// direction (w), positive outside. The functions keep the listings' names. They deviate from the listings in
// three ways, none of which moves the zero set of a well-formed patch:
//  - the listings' direction normalize(triPos - pos) * sign(height) is 0/0 on the base triangle; its
//    limit is used there;
//  - listing 3.6 works with radii 1/c, the curvature c clamped away from 0, which in single precision
//    leaves errors of 5e-2 on a flat patch; SphereDist here takes c and divides by it only where it must;
//  - where the line misses a sphere, rsi() returns 1e5; here the discriminant is taken as 0.

// Height of pos over the plane through origin with unit normal n.
real Height(vec3 pos, vec3 origin, vec3 n) { return dot3(pos - origin, n); }

// Weights of pos, a point of the plane of a, b, c, among them.
vec3 Barycentric(vec3 pos, vec3 a, vec3 b, vec3 c) {
  EXACT vec3 normal = cross3(b - a, c - a);
  EXACT real area = dot3(normal, normal);
  EXACT real wb = dot3(cross3(pos - a, c - a), normal) / area;
  EXACT real wc = dot3(cross3(b - a, pos - a), normal) / area;
  return vec3(real(1.0) - wb - wc, wb, wc);
}

// pos projected on the plane through origin with unit normal n.
vec3 Project(vec3 pos, vec3 origin, vec3 n) { return pos - n * dot3(pos - origin, n); }

// Distance from pos along dir to the plane through origin with normal n.
real PlaneDist(vec3 pos, vec3 dir, vec3 origin, vec3 n) {
  return dot3(origin - pos, n) / dot3(dir, n);
}

// The listings' dir: from pos toward the base triangle if above it, away if below.
vec3 inward(vec3 pos, vec3 triPos, real height, vec3 D) {
  EXACT vec3 toward = triPos - pos;
  EXACT real size = length3(toward);
  return height == real(0.0) || size == real(0.0) ? -normalize3(D) : toward * (sign(height) / size);
}

// Weights of pos in the copy of the base triangle that the shell lifts to pos's height.
vec3 offset_weights(Triangle tri, vec3 pos, real height) {
  return Barycentric(pos,
                     vec3(tri.Position[0]) + vec3(tri.Normal[0]) / tri.NormDot.x * height,
                     vec3(tri.Position[1]) + vec3(tri.Normal[1]) / tri.NormDot.y * height,
                     vec3(tri.Position[2]) + vec3(tri.Normal[2]) / tri.NormDot.z * height);
}

vec4 PhongField(Triangle tri, vec3 pos, real alpha) {
  vec3 P0 = vec3(tri.Position[0]);
  vec3 P1 = vec3(tri.Position[1]);
  vec3 P2 = vec3(tri.Position[2]);
  EXACT real height = Height(pos, P0, vec3(tri.TriNormal));
  EXACT vec3 weights = offset_weights(tri, pos, height);
  EXACT vec3 triPos = weigh(weights, P0, P1, P2);
  vec3 dir = inward(pos, triPos, height, shell_direction(SHELL_HEIGHT, tri, weights));
  EXACT vec3 phPos = weigh(weights, Project(triPos, P0, vec3(tri.Normal[0])),
                     Project(triPos, P1, vec3(tri.Normal[1])),
                     Project(triPos, P2, vec3(tri.Normal[2])));
  phPos = triPos * (real(1.0) - alpha) + phPos * alpha;
  return vec4(weights, PlaneDist(pos, dir, phPos, -dir));
}

// Distance from pos along the unit vector dir to the sphere c |x|^2 + 2 x.N = 0, x relative to vertex: to
// where the line enters a convex one or leaves a concave one, r.x - sign(r) r.y in the listing.
real SphereDist(vec3 pos, vec3 dir, vec3 vertex, vec3 N, real c) {
  vec3 x0 = pos - vertex;
  real B = c * dot3(x0, dir) + dot3(dir, N);
  real C = c * dot3(x0, x0) + real(2.0) * dot3(x0, N);
  real root = sqrt(max(B * B - c * C, real(0.0)));
  if (B < real(0.0)) return C / (root - B);
  return -(B + root) / (c > real(0.0) ? max(c, real(1e-6)) : min(c, real(-1e-6)));
}

vec4 SphereField(Triangle tri, vec3 pos) {
  vec3 P0 = vec3(tri.Position[0]);
  vec3 P1 = vec3(tri.Position[1]);
  vec3 P2 = vec3(tri.Position[2]);
  EXACT real height = Height(pos, P0, vec3(tri.TriNormal));
  EXACT vec3 weights = offset_weights(tri, pos, height);
  vec3 cw = clamp(weights, real(0.0), real(1.0));
  cw /= cw.x + cw.y + cw.z;
  EXACT vec3 triPos = weigh(cw, P0, P1, P2);
  vec3 dir = inward(pos, triPos, height, shell_direction(SHELL_HEIGHT, tri, cw));
  vec3 blends = curvature_blends(tri, cw, triPos);
  vec3 dist = vec3(SphereDist(pos, dir, P0, vec3(tri.Normal[0]), blended_curvature(blends.x, tri.VertexData[0])),
                   SphereDist(pos, dir, P1, vec3(tri.Normal[1]), blended_curvature(blends.y, tri.VertexData[1])),
                   SphereDist(pos, dir, P2, vec3(tri.Normal[2]), blended_curvature(blends.z, tri.VertexData[2])));
  return vec4(weights, dot3(dist, weights));
}

// The field in the normal shell, which the thesis does not have. The offset copy of the base triangle,
// P_i + s N_i, has pos in its plane where a cubic in s vanishes; Newton's method finds s from 0 on.
vec4 NormalShellField(Shape shape, Triangle tri, vec3 pos) {
  vec3 P0 = vec3(tri.Position[0]) - pos;
  vec3 P1 = vec3(tri.Position[1]) - pos;
  vec3 P2 = vec3(tri.Position[2]) - pos;
  vec3 N0 = vec3(tri.Normal[0]);
  vec3 N1 = vec3(tri.Normal[1]);
  vec3 N2 = vec3(tri.Normal[2]);
  // The volume of (P_0 + s N_0, P_1 + s N_1, P_2 + s N_2) about pos, a cubic a + b s + c s^2 + d s^3.
  real a = dot3(P0, cross3(P1, P2));
  real b = dot3(N0, cross3(P1, P2)) + dot3(P0, cross3(N1, P2)) + dot3(P0, cross3(P1, N2));
  real c = dot3(P0, cross3(N1, N2)) + dot3(N0, cross3(P1, N2)) + dot3(N0, cross3(N1, P2));
  real d = dot3(N0, cross3(N1, N2));
  real s = -a / b;
  for (int i = 0; i < 4; ++i) {
    s -= (a + s * (b + s * (c + s * d))) / (b + s * (real(2.0) * c + s * (real(3.0) * d)));
  }
  EXACT vec3 weights = Barycentric(vec3(0.0), P0 + N0 * s, P1 + N1 * s, P2 + N2 * s);
  EXACT real size = length3(shell_direction(SHELL_NORMAL, tri, weights));
  return vec4(weights, (s - displacement(shape, tri, weights)) * size);
}

vec4 Field(Shape shape, Triangle tri, vec3 pos) {
  if (shape.shell == SHELL_NORMAL) return NormalShellField(shape, tri, pos);
  if (shape.surface == SURFACE_PHONG) return PhongField(tri, pos, shape.alpha);
  return SphereField(tri, pos);
}
