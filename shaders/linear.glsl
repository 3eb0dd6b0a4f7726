// Of two numbers; if one is a NaN, b. min() and max() keep to the other one's value then, for which llvmpipe takes three
// instructions in place of one: 2 to 9% of a frame.
real smaller_of(real a, real b) { return a < b ? a : b; }

real larger_of(real a, real b) { return a > b ? a : b; }

// Vector products as explicit sums, so that every compiler (glslang, Mesa's OpenGL front end, g++, clang)
// rounds in the same order; the built-in dot and normalize do not promise that.
real dot3(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

vec3 cross3(vec3 a, vec3 b) {
  return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

real length3(vec3 a) { return sqrt(dot3(a, a)); }

vec3 normalize3(vec3 a) { return a / length3(a); }

// The normal on the side that `view` looks at.
vec3 facing(vec3 normal, vec3 view) { return dot3(normal, view) > real(0.0) ? -normal : normal; }

// The point with barycentric weights w among a, b, c.
vec3 weigh(vec3 w, vec3 a, vec3 b, vec3 c) { return a * w.x + b * w.y + c * w.z; }

// Angle between a and b, from 0 to pi. The thesis takes acos of a dot product, which loses half the digits near 0. The
// arc tangent of |a x b| / a.b does not (Kahan 2006, "How futile are mindless assessments of roundoff in floating-point
// computation?", on the angle between vectors). A vector of length 0 has angle 0 with all: atan(0, 0) is
// undefined in GLSL.
real AngleBetween(vec3 a, vec3 b) {
  real sine = length3(cross3(a, b));
  real cosine = dot3(a, b);
  return sine == real(0.0) && cosine == real(0.0) ? real(0.0) : polar_angle(sine, cosine);
}
