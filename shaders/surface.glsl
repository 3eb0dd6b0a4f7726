// The surfaces in closed form. A point of the base triangle with weights w is T(w) = sum w_i P_i; the shell gives
// it a direction D(w), the surface a displacement sigma(w) in units of D: S(w) = T(w) + sigma(w) D(w).
//
// Shells:
// height: D = sum w_i N_i / (N_i.n), the thesis's. D.n = 1, so sigma is the height over the base plane. The two faces
//         of an edge divide by different N_i.n, so their curved edges differ and leave gaps.
// normal: D = sum w_i N_i. Along an edge S depends on the edge's own vertices and normals: watertight.
//
// Surfaces:
// flat:   sigma = 0.
// phong:  the Phong Tessellation of Boubekeur & Alexa 2008 (eq. 1: project T on the three tangent planes, blend,
//         mix by alpha). height: projected on the line T + s D. normal: sigma = sum_{i<j} s_ij w_i w_j with
//         s_ij = alpha E_ij.(N_j - N_i), the component of Phong Tessellation's edge curve along the edge's two
//         normals; S is a cubic Bezier triangle.
// sphere: each vertex has a sphere through it with its normal, whose curvature is interpolated between those of the
//         two edges that leave the vertex (spherical interpolation after Gusiatin et al. 2017, 2018);
//         sigma = sum w_i s_i, where T + s_i D meets sphere i.
//
// Derivatives are along u = w_1 and v = w_2 with w_0 = 1 - u - v.

// Relative to the size of a position, the farthest vertex's or the point's own: what a point of a patch may be off by in
// single precision. The weighted sum of three vertices takes 3 roundings and the subtraction of the ray's anchor 1, so this
// must be at least gamma(4). The solver's steps end by it: another value would end them elsewhere.
const real ROUNDINGS = real(2.4e-7);

// The distance of the farthest of a point and the patch's vertices from the scene's origin.
real farthest(vec3 point, Triangle tri) {
  real vertex = max(length3(vec3(tri.Position[0])),
                    max(length3(vec3(tri.Position[1])), length3(vec3(tri.Position[2]))));
  return max(length3(point), vertex);
}

vec3 base_point(Triangle tri, vec3 w) {
  return weigh(w, vec3(tri.Position[0]), vec3(tri.Position[1]), vec3(tri.Position[2]));
}

// D at vertex i, from its normal and its entry of NormDot.
vec3 corner_direction(uint shell, vec4 normal, real cosine) {
  return shell == SHELL_HEIGHT ? vec3(normal) / cosine : vec3(normal);
}

vec3 shell_direction(uint shell, Triangle tri, vec3 w) {
  return weigh(w, corner_direction(shell, tri.Normal[0], tri.NormDot.x),
               corner_direction(shell, tri.Normal[1], tri.NormDot.y),
               corner_direction(shell, tri.Normal[2], tri.NormDot.z));
}

vec3 vertex_normal(Triangle tri, vec3 w) {
  return weigh(w, vec3(tri.Normal[0]), vec3(tri.Normal[1]), vec3(tri.Normal[2]));
}

// Phong Tessellation's offset from T at alpha = 1: sum w_i ((P_i - T).N_i) N_i.
vec3 phong_offset(Triangle tri, vec3 w, vec3 T) {
  vec3 k = vec3(dot3(vec3(tri.Position[0]) - T, vec3(tri.Normal[0])),
                dot3(vec3(tri.Position[1]) - T, vec3(tri.Normal[1])),
                dot3(vec3(tri.Position[2]) - T, vec3(tri.Normal[2])));
  return weigh(w * k, vec3(tri.Normal[0]), vec3(tri.Normal[1]), vec3(tri.Normal[2]));
}

// s_ij of phong in the normal shell. Exchanging i and j changes two signs and no rounding.
real edge_bulge(vec4 Pi, vec4 Pj, vec4 Ni, vec4 Nj, real alpha) {
  return alpha * dot3(vec3(Pj) - vec3(Pi), vec3(Nj) - vec3(Ni));
}

// Whether S is a cubic Bezier triangle and sigma a quadratic.
bool is_cubic(Shape shape) { return shape.surface == SURFACE_PHONG && shape.shell == SHELL_NORMAL; }

// (s_01, s_12, s_02).
vec3 edge_bulges(Triangle tri, real alpha) {
  return vec3(edge_bulge(tri.Position[0], tri.Position[1], tri.Normal[0], tri.Normal[1], alpha),
              edge_bulge(tri.Position[1], tri.Position[2], tri.Normal[1], tri.Normal[2], alpha),
              edge_bulge(tri.Position[0], tri.Position[2], tri.Normal[0], tri.Normal[2], alpha));
}

// Where the line x0 + s dir, x0 relative to the vertex, leaves the sphere c |x|^2 + 2 x.N = 0 of curvature c through
// the vertex, or enters a hollow one, on the side to which N points: A s^2 + 2 B s + C = 0, the root with A s + B >= 0.
// A line that misses the sphere gets the point where it passes closest to it, s = -B / A, which is continuous with the
// point at which a line touches it. For B > 0 the quadratic formula is taken in the form -C / (B + root), in which nothing
// cancels and which holds for a plane, c = 0, too.
real sphere_root(vec3 x0, vec3 dir, vec3 N, real c) {
  real A = c * dot3(dir, dir);
  real B = c * dot3(x0, dir) + dot3(dir, N);
  real C = c * dot3(x0, x0) + real(2.0) * dot3(x0, N);
  bool plane = A == real(0.0);
  if (C == real(0.0) && (plane || B >= real(0.0))) return real(0.0);
  real discriminant = B * B - A * C;
  real root = plane ? B : sqrt(max(discriminant, real(0.0)));
  return plane || (B > real(0.0) && discriminant > real(0.0)) ? -C / (B + root) : (root - B) / A;
}

// Where the direction from a vertex to the point T lies between the vertex's neighbours, linear in the angle: 0 toward b,
// 1 toward a, whose weight at T is w_a. It goes on beyond the edges, so that the surface is smooth there, but not all
// around the vertex.
const real LEAST_BLEND = real(-1.0);
const real MOST_BLEND = real(2.0);
real curvature_blend(vec3 T, real w_a, vec3 vertex, vec3 b, vec4 data) {
  real angle = AngleBetween(T - vertex, b - vertex);
  return clamp((w_a < real(0.0) ? -angle : angle) / data.z, LEAST_BLEND, MOST_BLEND);
}

// The curvature at a vertex in that direction. data.x: curvature toward a, the neighbour with the lower number; data.y:
// toward b; data.z: the angle between the two, in radians.
real blended_curvature(real blend, vec4 data) { return data.y + blend * (data.x - data.y); }

// curvature_blend at each vertex.
vec3 curvature_blends(Triangle tri, vec3 w, vec3 T) {
  vec3 P0 = vec3(tri.Position[0]);
  vec3 P1 = vec3(tri.Position[1]);
  vec3 P2 = vec3(tri.Position[2]);
  return vec3(curvature_blend(T, w.y, P0, P2, tri.VertexData[0]), curvature_blend(T, w.x, P1, P2, tri.VertexData[1]),
              curvature_blend(T, w.x, P2, P1, tri.VertexData[2]));
}

// The sine of the angle between D and a vertex's tangent plane below which the displacement toward its sphere is limited
// further, down to 0 in the plane and beneath it: the definition would send it to infinity there.
const real FLAT_SINE = real(0.25);

// The farthest that a point x0 from a vertex is displaced toward its sphere, in units of D: as far as it is from the
// vertex. An arc of up to a half circle stays within this distance of its chord. Both faces of an edge have the same limit
// along it.
real height_limit(vec3 x0, vec3 D, vec3 N) {
  real size = length3(D);
  return length3(x0) * clamp(dot3(D, N) / (FLAT_SINE * size), real(0.0), real(1.0)) / size;
}

// s_i of the sphere surface: the displacement, in units of D, toward the sphere of vertex i, whose curvature is c.
real sphere_height(vec3 T, vec3 D, vec3 vertex, vec3 N, real c) {
  vec3 x0 = T - vertex;
  real limit = height_limit(x0, D, N);
  return clamp(sphere_root(x0, D, N, c), -limit, limit);
}

vec3 sphere_heights(Triangle tri, vec3 T, vec3 D, vec3 blends) {
  return vec3(sphere_height(T, D, vec3(tri.Position[0]), vec3(tri.Normal[0]),
                            blended_curvature(blends.x, tri.VertexData[0])),
              sphere_height(T, D, vec3(tri.Position[1]), vec3(tri.Normal[1]),
                            blended_curvature(blends.y, tri.VertexData[1])),
              sphere_height(T, D, vec3(tri.Position[2]), vec3(tri.Normal[2]),
                            blended_curvature(blends.z, tri.VertexData[2])));
}

// sigma(w).
real displacement(Shape shape, Triangle tri, vec3 w) {
  if (shape.surface == SURFACE_FLAT) return real(0.0);
  if (is_cubic(shape)) {
    vec3 bulge = edge_bulges(tri, shape.alpha);
    return bulge.x * w.x * w.y + bulge.y * w.y * w.z + bulge.z * w.x * w.z;
  }
  vec3 T = base_point(tri, w);
  vec3 D = shell_direction(shape.shell, tri, w);
  if (shape.surface == SURFACE_PHONG) {
    return shape.alpha * dot3(D, phong_offset(tri, w, T)) / dot3(D, D);
  }
  return dot3(w, sphere_heights(tri, T, D, curvature_blends(tri, w, T)));
}

vec3 surface_point(Shape shape, Triangle tri, vec3 w) {
  return base_point(tri, w) + shell_direction(shape.shell, tri, w) * displacement(shape, tri, w);
}

// Derivative of phong's sigma in the height shell when w moves by dw (sum 0), T by dT and D by dD.
real phong_derivative(Triangle tri, vec3 w, vec3 dw, vec3 T, vec3 dT, vec3 D, vec3 dD, real alpha) {
  vec3 N0 = vec3(tri.Normal[0]);
  vec3 N1 = vec3(tri.Normal[1]);
  vec3 N2 = vec3(tri.Normal[2]);
  vec3 k = vec3(dot3(vec3(tri.Position[0]) - T, N0), dot3(vec3(tri.Position[1]) - T, N1),
                dot3(vec3(tri.Position[2]) - T, N2));
  vec3 dk = -vec3(dot3(dT, N0), dot3(dT, N1), dot3(dT, N2));
  vec3 K = weigh(w * k, N0, N1, N2);
  vec3 dK = weigh(dw * k + w * dk, N0, N1, N2);
  real DD = dot3(D, D);
  return alpha * (dot3(dD, K) + dot3(D, dK) - real(2.0) * dot3(D, K) * dot3(D, dD) / DD) / DD;
}

// Gradient of s_i, where `blend` is curvature_blend there. `turn` is +n or -n, the axis about which the angle from the
// neighbour b to the point grows. Where s_i is not differentiable it is an element of the generalised gradient (Clarke
// 1983), the limit of gradients from one side.
Gradient sphere_gradient(vec3 T, vec3 D, real s, vec3 vertex, vec3 N, real blend, vec4 data, vec3 turn) {
  EXACT Gradient gradient;
  vec3 x0 = T - vertex;
  real xx = dot3(x0, x0);
  real DD = dot3(D, D);
  real DN = dot3(D, N);
  if (xx == real(0.0)) {
    gradient.along_T = -N / DN;
    gradient.along_D = vec3(0.0);
    return gradient;
  }
  if (abs(s) >= height_limit(x0, D, N)) {
    // s_i is the limit: differentiate height_limit.
    bool flat_on = DN < FLAT_SINE * sqrt(DD);
    gradient.along_T = x0 * (s / xx);
    gradient.along_D = D * ((flat_on ? real(-2.0) : real(-1.0)) * s / DD);
    if (flat_on && DN > real(0.0)) gradient.along_D += N * (s / DN);
    return gradient;
  }
  bool turns = blend > LEAST_BLEND && blend < MOST_BLEND;
  real c = blended_curvature(blend, data);
  // The gradient of c by T.
  vec3 dc = turns ? cross3(turn, x0) * ((data.x - data.y) / (xx * data.z)) : vec3(0.0);
  vec3 p = x0 + D * s;
  real A = c * DD;
  real B = c * dot3(x0, D) + DN;
  real C = c * xx + real(2.0) * dot3(x0, N);
  if (B * B - A * C <= real(0.0)) {
    // s = -B / A, the point p that is closest to the sphere.
    gradient.along_T = -(D * c + dc * dot3(p, D)) / A;
    gradient.along_D = -(N + (p + D * s) * c) / A;
    return gradient;
  }
  // Half the sphere's function F = c p.p + 2 p.N, 0 at p, changes with p by g and with s by g.D.
  vec3 g = p * c + N;
  real slope = A * s + B;
  gradient.along_T = -(g + dc * (real(0.5) * dot3(p, p))) / slope;
  gradient.along_D = g * (-s / slope);
  return gradient;
}

// sigma and its derivatives of phong in the normal shell, from its (s_01, s_12, s_02).
Displacement bulged(vec3 bulge, vec3 w) {
  EXACT Displacement sigma;
  sigma.s = bulge.x * w.x * w.y + bulge.y * w.y * w.z + bulge.z * w.x * w.z;
  sigma.u = bulge.x * (w.x - w.y) + (bulge.y - bulge.z) * w.z;
  sigma.v = bulge.z * (w.x - w.z) + (bulge.y - bulge.x) * w.y;
  return sigma;
}

Displacement displacement_and_derivatives(Shape shape, Triangle tri, vec3 w) {
  Displacement sigma;
  sigma.s = real(0.0);
  sigma.u = real(0.0);
  sigma.v = real(0.0);
  if (shape.surface == SURFACE_FLAT) return sigma;
  if (is_cubic(shape)) {
    return bulged(edge_bulges(tri, shape.alpha), w);
  }
  vec3 P0 = vec3(tri.Position[0]);
  vec3 P1 = vec3(tri.Position[1]);
  vec3 P2 = vec3(tri.Position[2]);
  vec3 D0 = corner_direction(shape.shell, tri.Normal[0], tri.NormDot.x);
  vec3 Du = corner_direction(shape.shell, tri.Normal[1], tri.NormDot.y) - D0;
  vec3 Dv = corner_direction(shape.shell, tri.Normal[2], tri.NormDot.z) - D0;
  vec3 T = base_point(tri, w);
  vec3 Tu = P1 - P0;
  vec3 Tv = P2 - P0;
  vec3 D = shell_direction(shape.shell, tri, w);
  vec3 du = vec3(-1.0, 1.0, 0.0);
  vec3 dv = vec3(-1.0, 0.0, 1.0);
  if (shape.surface == SURFACE_PHONG) {
    sigma.s = shape.alpha * dot3(D, phong_offset(tri, w, T)) / dot3(D, D);
    sigma.u = phong_derivative(tri, w, du, T, Tu, D, Du, shape.alpha);
    sigma.v = phong_derivative(tri, w, dv, T, Tv, D, Dv, shape.alpha);
    return sigma;
  }
  vec3 n = vec3(tri.TriNormal);
  vec3 N0 = vec3(tri.Normal[0]);
  vec3 N1 = vec3(tri.Normal[1]);
  vec3 N2 = vec3(tri.Normal[2]);
  vec3 blends = curvature_blends(tri, w, T);
  vec3 s = sphere_heights(tri, T, D, blends);
  // The angle at a vertex is measured from neighbour b; seen along n, b follows a at vertices 0 and 2
  // (so the angle shrinks as the point turns about +n) and precedes it at vertex 1.
  Gradient d0 = sphere_gradient(T, D, s.x, P0, N0, blends.x, tri.VertexData[0], -n);
  Gradient d1 = sphere_gradient(T, D, s.y, P1, N1, blends.y, tri.VertexData[1], n);
  Gradient d2 = sphere_gradient(T, D, s.z, P2, N2, blends.z, tri.VertexData[2], -n);
  vec3 su = vec3(dot3(d0.along_T, Tu) + dot3(d0.along_D, Du), dot3(d1.along_T, Tu) + dot3(d1.along_D, Du),
                 dot3(d2.along_T, Tu) + dot3(d2.along_D, Du));
  vec3 sv = vec3(dot3(d0.along_T, Tv) + dot3(d0.along_D, Dv), dot3(d1.along_T, Tv) + dot3(d1.along_D, Dv),
                 dot3(d2.along_T, Tv) + dot3(d2.along_D, Dv));
  sigma.s = dot3(w, s);
  sigma.u = dot3(du, s) + dot3(w, su);
  sigma.v = dot3(dv, s) + dot3(w, sv);
  return sigma;
}

// The geometric normal S_u x S_v, of unit length. It is on the side of the face normal unless the shell folds over.
vec3 geometric_normal(Shape shape, Triangle tri, vec3 w) {
  if (shape.surface == SURFACE_FLAT) return vec3(tri.TriNormal);
  Displacement sigma = displacement_and_derivatives(shape, tri, w);
  vec3 D0 = corner_direction(shape.shell, tri.Normal[0], tri.NormDot.x);
  vec3 Du = corner_direction(shape.shell, tri.Normal[1], tri.NormDot.y) - D0;
  vec3 Dv = corner_direction(shape.shell, tri.Normal[2], tri.NormDot.z) - D0;
  vec3 D = shell_direction(shape.shell, tri, w);
  vec3 Su = vec3(tri.Position[1]) - vec3(tri.Position[0]) + D * sigma.u + Du * sigma.s;
  vec3 Sv = vec3(tri.Position[2]) - vec3(tri.Position[0]) + D * sigma.v + Dv * sigma.s;
  return normalize3(cross3(Su, Sv));
}

// The origin of a shadow ray from the point with weights w, toward a light on the side of the geometric normal n. It is
// moved along n by four times what roundings may displace the point, so that the ray does not meet the surface where it
// leaves it. Where the surface is concave the ray can still meet it farther off, as it should.
vec3 shadow_ray_origin(Shape shape, Triangle tri, vec3 w, vec3 n) {
  EXACT vec3 point = surface_point(shape, tri, w);
  return point + n * (real(4.0) * ROUNDINGS * farthest(point, tri));
}
