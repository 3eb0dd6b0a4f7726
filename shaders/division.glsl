// What a product a b is short of its rounded value p, exactly (Dekker 1971, "A floating-point technique for extending the
// available precision"). No over- or underflow must occur.
real product_error(real a, real b, real p) {
  const real SPLIT = BY_PRECISION(real(4097.0), real(134217729.0));
  EXACT real a_scaled = SPLIT * a;
  EXACT real b_scaled = SPLIT * b;
  EXACT real a_high = a_scaled - (a_scaled - a);
  EXACT real b_high = b_scaled - (b_scaled - b);
  EXACT real a_low = a - a_high;
  EXACT real b_low = b - b_high;
  EXACT real error = ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low;
  return error;
}

// a / b and sqrt(a) rounded as IEEE 754 has it. Vulkan lets a division be off by 2.5 ulp, and a root by more; Newton's
// method corrects what either is short of. For what makes up a ray, from which all that follows is computed: a root of the
// surface is found from the residual f, which forgives the divisions on the way.
real divide(real a, real b) {
  real q = a / b;
  EXACT real p = q * b;
  EXACT real rest = (a - p) - product_error(q, b, p);
  EXACT real corrected = q + rest / b;
  return corrected;
}

real square_root(real a) {
  real s = sqrt(a);
  EXACT real p = s * s;
  EXACT real rest = (a - p) - product_error(s, s, p);
  EXACT real corrected = s + rest / (s + s);
  return a > real(0.0) ? corrected : real(0.0);
}

vec2 divide2(vec2 a, real b) { return vec2(divide(a.x, b), divide(a.y, b)); }

vec3 divide3(vec3 a, real b) { return vec3(divide(a.x, b), divide(a.y, b), divide(a.z, b)); }
