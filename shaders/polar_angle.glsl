// Angle in radians, from 0 to pi, of the point (cosine, sine) with sine >= 0, in single precision. The built-in atan rounds
// differently in every compiler; Vulkan allows it 4096 units in the last place. The polynomial is a minimax fit of
// (atan(x) / x - 1) / x^2 for 0 <= x <= tan(pi / 8), with an error of 2e-8 relative to the angle.
real polar_angle(real sine, real cosine) {
  real across = abs(cosine);
  real smaller = min(sine, across);
  real larger = max(sine, across);
  real x = smaller / larger;
  // atan(x) = pi / 4 + atan((x - 1) / (x + 1)).
  bool far = x > real(0.41421357);
  real y = far ? (smaller - larger) / (smaller + larger) : x;
  real z = y * y;
  real p = ((real(0.08060252684) * z - real(0.1387983158)) * z + real(0.1997792424)) * z - real(0.333329552);
  real angle = y + y * z * p;
  if (far) angle = real(0.7853981634) + angle;
  if (sine > across) angle = real(1.5707963268) - angle;
  return cosine < real(0.0) ? real(3.1415926536) - angle : angle;
}
