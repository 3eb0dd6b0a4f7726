// The thesis's intersection of a ray with one triangle, listing 3.4: the chord of the bounding ball is
// halved rank - 1 times toward the surface, and its last point is a hit if the field there is small enough.
// It finds front faces only, some root rather than the first one, and can step past one. It is the baseline
// that this project measures itself against, so these faults are kept.

// Middle and half length of the chord that the ball of radius sr about the origin cuts from r0 + t rd;
// (1e5, -1e5) if it cuts none.
vec2 rsi(vec3 r0, vec3 rd, real sr) {
  real a = dot3(rd, rd);
  real b = real(2.0) * dot3(rd, r0);
  real c = dot3(r0, r0) - sr * sr;
  real d = b * b - real(4.0) * a * c;
  if (d < real(0.0)) return vec2(real(1e5), real(-1e5));
  return vec2(-b / (real(2.0) * a), sqrt(d) / (real(2.0) * a));
}

// Whether the ray can meet what lies in the ball: its chord exists and does not begin behind the origin.
bool chord_ahead(vec2 bounds) { return !(bounds.y < real(0.0) || bounds.x - bounds.y < real(0.0)); }

// Ray NearPos + t view (|view| = 1) against the displaced triangle, whose ball it cuts in `bounds`.
// On a hit: its depth t, less than cdepth, and its weights.
bool bisect(Shape shape, Triangle tri, vec2 bounds, vec3 NearPos, vec3 view, int Rank, real resolution,
            real minDelta, real cdepth, OUT(real) depth, OUT(vec3) weights) {
  vec3 near = NearPos + view * (bounds.x - bounds.y);
  vec3 far = NearPos + view * (bounds.x + bounds.y);
  real deltaLength = max(length3(far - near) * resolution, minDelta);
  vec3 curDelta = (far - near) / real(2.0);
  vec3 cpos = (near + far) / real(2.0);
  real curScene = real(1000.0);
  weights = vec3(0.0);
  for (int i = 1; i < Rank; i++) {
    vec4 field = Field(shape, tri, cpos);
    curScene = field.w;
    weights = vec3(field);
    vec3 curNorm = vertex_normal(tri, weights);
    curDelta /= real(2.0);
    real dir = sign(curScene);
    dir = min(-sign(dot3(curNorm, view)), dir);
    if (dir == real(0.0)) dir = real(1.0);
    cpos += curDelta * dir;
  }
  depth = length3(cpos - NearPos);
  real b = min(min(weights.x, weights.y), weights.z);
  return abs(curScene) <= deltaLength && b >= real(0.0) && depth < cdepth &&
         length3(far - cpos) > real(1e-3);
}

// A flat patch needs no bisection, as a ray meets its plane once. The test is Moeller & Trumbore's (1997), for
// front faces only, as above.
bool hit_flat(Triangle tri, vec3 NearPos, vec3 view, real cdepth, OUT(real) depth,
              OUT(vec3) weights) {
  vec3 P0 = vec3(tri.Position[0]);
  vec3 E1 = vec3(tri.Position[1]) - P0;
  vec3 E2 = vec3(tri.Position[2]) - P0;
  vec3 p = cross3(view, E2);
  real determinant = dot3(E1, p);
  vec3 s = NearPos - P0;
  vec3 q = cross3(s, E1);
  real u = dot3(s, p) / determinant;
  real v = dot3(view, q) / determinant;
  depth = dot3(E2, q) / determinant;
  weights = vec3(real(1.0) - u - v, u, v);
  return determinant > real(0.0) && u >= real(0.0) && v >= real(0.0) && u + v <= real(1.0) &&
         depth >= real(0.0) && depth < cdepth;
}
