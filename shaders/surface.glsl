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

// The least cosine of the angle between D and the normal of the sphere where they meet. Flatter lines, and those that miss
// the sphere, leave the definition, which has an infinite slope where they touch, smoothly.
const real LEAST_SLOPE = real(0.5);
// In units of 1 / |x|: where the slope is held up s moves by an amount over c, of curvatures small against this by less.
const real CURVED = real(0.5);
// A height is at most this part of the distance from the vertex, in units of D. Up to three quarters of it, 5/4 of the
// distance, it is as it is; from there a parabola leads to the whole, which it reaches at five quarters. An arc of up to a
// half circle stays within the distance from its end, and so does a plane through the vertex next to it, however the
// normal leans.
const real HIGHEST = real(5.0) / real(3.0);
const real FREE = real(0.75);
const real HELD = real(1.25);

// d where it is at least `least`, otherwise a parabola down to least / 2 at 0, and that below. The derivative is continuous.
real held_square(real d, real least) {
  real positive = max(d, real(0.0));
  return d >= least ? d : real(0.5) * (least + positive * positive / least);
}

// 1 / z for z of at least 1, otherwise a cubic down to 0 at 0, and that below; and its derivative, which is continuous.
real held_inverse(real z) {
  real positive = max(z, real(0.0));
  return z >= real(1.0) ? real(1.0) / z : positive * positive * (real(4.0) - real(3.0) * positive);
}

real held_inverse_slope(real z) {
  real positive = max(z, real(0.0));
  return z >= real(1.0) ? real(-1.0) / (z * z) : positive * (real(8.0) - real(9.0) * positive);
}

// The line T + s D and the sphere c |x|^2 + 2 x.N = 0 of curvature c through a vertex with its normal N, x relative to the
// vertex. They meet where A s^2 + 2 B s + C = 0, at the slope A s + B, half the derivative of that.
struct SphereLine {
  real xx;       // |x|^2 of the base point
  real DD;
  real xD;
  real A;
  real B;
  real C;
  real square;   // of the slope, B^2 - A C; negative if the line misses the sphere
  real slope;    // the square's root, the square held up
  real sum;      // B + slope
  bool regular;  // the definition holds
  real s;        // where they meet, or what takes its place, in units of D
};

// 1 / c for large c |x|, falling to 0 with the curvature, as a plane has no nearest point to a line that does not meet it.
real by_curvature(real c, real xx) { return c * xx / (c * c * xx + CURVED * CURVED); }

// Of the two points where a line meets a sphere the one with A s + B >= 0 counts, where it leaves the sphere, or enters a
// hollow one, on the side to which N points: s = -C / (B + sqrt(B^2 - A C)), in which nothing cancels and which holds for a
// plane, c = 0, too. Where the slope is too small its square is held up, as if the sphere lay nearer to the line, which makes
// C that of such a sphere: (slope - B) / A in the form above. Where the denominator is too small, its inverse falls to 0: such
// a point is on the wrong side.
SphereLine sphere_line(vec3 x0, vec3 D, vec3 N, real c) {
  SphereLine line;
  line.xx = dot3(x0, x0);
  line.DD = dot3(D, D);
  line.xD = dot3(x0, D);
  line.A = c * line.DD;
  line.B = c * line.xD + dot3(D, N);
  line.C = c * line.xx + real(2.0) * dot3(x0, N);
  line.square = line.B * line.B - line.A * line.C;
  real least = LEAST_SLOPE * LEAST_SLOPE * line.DD;
  line.slope = sqrt(held_square(line.square, least));
  line.sum = line.B + line.slope;
  line.regular = line.square >= least && line.sum > real(0.0) && line.sum * line.sum >= real(4.0) * least;
  if (line.regular) {
    line.s = -line.C / line.sum;
  } else {
    real least_sum = real(2.0) * sqrt(least);
    real lifted = (line.slope * line.slope - line.square) / line.DD;
    line.s = (lifted * by_curvature(c, line.xx) - line.C) * held_inverse(line.sum / least_sum) / least_sum;
  }
  return line;
}

// A height held below `highest`.
real held_height(real s, real highest) {
  if (abs(s) <= FREE * highest) return s;
  real left = max(HELD - abs(s) / highest, real(0.0));
  real held = highest * (real(1.0) - left * left);
  return s < real(0.0) ? -held : held;
}

// The most that a line's height can be.
real highest_of(SphereLine line) { return HIGHEST * sqrt(line.xx / line.DD); }

// Whether a line's height is its s.
bool is_free(SphereLine line) {
  return line.s * line.s * line.DD <= FREE * HIGHEST * FREE * HIGHEST * line.xx;
}

// s_i of the sphere surface: the displacement, in units of D, toward the sphere of vertex i.
real sphere_height(SphereLine line) { return is_free(line) ? line.s : held_height(line.s, highest_of(line)); }

// At the point T along D of vertex i, whose curvature is c there.
SphereLine vertex_line(Triangle tri, int i, vec3 T, vec3 D, real blend) {
  return sphere_line(T - vec3(tri.Position[i]), D, vec3(tri.Normal[i]), blended_curvature(blend, tri.VertexData[i]));
}

vec3 sphere_heights(Triangle tri, vec3 T, vec3 D, vec3 blends) {
  return vec3(sphere_height(vertex_line(tri, 0, T, D, blends.x)), sphere_height(vertex_line(tri, 1, T, D, blends.y)),
              sphere_height(vertex_line(tri, 2, T, D, blends.z)));
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

// Gradient of the line's s where the definition does not hold, c and its gradient by T given.
Gradient irregular_gradient(SphereLine line, vec3 x0, vec3 D, vec3 N, real c, vec3 dc) {
  EXACT Gradient gradient;
  // The derivatives of B, C, the square and the slope by T and D.
  vec3 g = x0 * c + N;
  vec3 B_T = dc * line.xD + D * c;
  vec3 C_T = dc * line.xx + g * real(2.0);
  vec3 square_T = B_T * (real(2.0) * line.B) - C_T * line.A - dc * (line.DD * line.C);
  vec3 square_D = g * (real(2.0) * line.B) - D * (real(2.0) * c * line.C);
  real least = LEAST_SLOPE * LEAST_SLOPE * line.DD;
  real kept = clamp(line.square / least, real(0.0), real(1.0));
  vec3 held_T = square_T * kept;
  vec3 held_D = square_D * kept + D * (LEAST_SLOPE * LEAST_SLOPE * (real(1.0) - kept * kept));
  if (line.square >= least) held_D = square_D;
  real least_sum = real(2.0) * sqrt(least);
  real ratio = line.sum / least_sum;
  vec3 ratio_T = (B_T + held_T * (real(0.5) / line.slope)) / least_sum;
  vec3 ratio_D = (g + held_D * (real(0.5) / line.slope)) / least_sum - D * (ratio / line.DD);
  // s = (lifted * nearer - C) * held_inverse(ratio) / least_sum
  real lifted = (line.slope * line.slope - line.square) / line.DD;
  vec3 lifted_T = (held_T - square_T) / line.DD;
  vec3 lifted_D = (held_D - square_D) / line.DD - D * (real(2.0) * lifted / line.DD);
  real nearer = by_curvature(c, line.xx);
  real q = c * c * line.xx + CURVED * CURVED;
  vec3 nearer_T = dc * (line.xx * (CURVED * CURVED - c * c * line.xx) / (q * q)) +
                  x0 * (real(2.0) * c * CURVED * CURVED / (q * q));
  real rise = lifted * nearer - line.C;
  real inverse = held_inverse(ratio) / least_sum;
  real inverse_slope = held_inverse_slope(ratio) / least_sum;
  gradient.along_T = (lifted_T * nearer + nearer_T * lifted - C_T) * inverse + ratio_T * (rise * inverse_slope);
  gradient.along_D = lifted_D * (nearer * inverse) + ratio_D * (rise * inverse_slope) - D * (line.s / line.DD);
  return gradient;
}

// Gradient of s_i, where `blend` is curvature_blend and `line` vertex_line there. `turn` is +n or -n, the axis about which
// the angle from the neighbour b to the point grows.
Gradient sphere_gradient(SphereLine line, vec3 T, vec3 D, vec3 vertex, vec3 N, real blend, vec4 data, vec3 turn) {
  EXACT Gradient gradient;
  if (line.xx == real(0.0)) {
    gradient.along_T = -N / dot3(D, N);
    gradient.along_D = vec3(0.0);
    return gradient;
  }
  vec3 x0 = T - vertex;
  real c = blended_curvature(blend, data);
  bool turns = blend > LEAST_BLEND && blend < MOST_BLEND;
  // The gradient of c by T.
  vec3 dc = turns ? cross3(turn, x0) * ((data.x - data.y) / (line.xx * data.z)) : vec3(0.0);
  if (line.regular) {
    // Half the sphere's function F = c p.p + 2 p.N, 0 at p, changes with p by g and with s by g.D, the slope.
    vec3 p = x0 + D * line.s;
    vec3 g = p * c + N;
    gradient.along_T = -(g + dc * (real(0.5) * dot3(p, p))) / line.slope;
    gradient.along_D = g * (-line.s / line.slope);
  } else {
    gradient = irregular_gradient(line, x0, D, N, c, dc);
  }
  if (is_free(line)) return gradient;
  // held_height = highest (1 - left^2)
  real highest = highest_of(line);
  real left = max(HELD - abs(line.s) / highest, real(0.0));
  real of_highest = highest * (real(1.0) - left * (real(2.0) * HELD - left));
  if (line.s < real(0.0)) of_highest = -of_highest;
  gradient.along_T = gradient.along_T * (real(2.0) * left) + x0 * (of_highest / line.xx);
  gradient.along_D = gradient.along_D * (real(2.0) * left) - D * (of_highest / line.DD);
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
  SphereLine l0 = vertex_line(tri, 0, T, D, blends.x);
  SphereLine l1 = vertex_line(tri, 1, T, D, blends.y);
  SphereLine l2 = vertex_line(tri, 2, T, D, blends.z);
  vec3 s = vec3(sphere_height(l0), sphere_height(l1), sphere_height(l2));
  // The angle at a vertex is measured from neighbour b; seen along n, b follows a at vertices 0 and 2
  // (so the angle shrinks as the point turns about +n) and precedes it at vertex 1.
  Gradient d0 = sphere_gradient(l0, T, D, P0, N0, blends.x, tri.VertexData[0], -n);
  Gradient d1 = sphere_gradient(l1, T, D, P1, N1, blends.y, tri.VertexData[1], n);
  Gradient d2 = sphere_gradient(l2, T, D, P2, N2, blends.z, tri.VertexData[2], -n);
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
