// A colour for a number, such that near numbers have distinct colours: the hue advances by the golden ratio, the brightness
// by another irrational number.
vec3 patch_color(uint number) {
  real hue = fract(real(number) * real(0.6180339887));
  real brightness = real(0.55) + real(0.45) * fract(real(number) * real(0.7548776662));
  vec3 sixths = fract(vec3(hue) + vec3(0.0, 2.0, 1.0) / real(3.0)) * real(6.0);
  vec3 circle = clamp(abs(sixths - vec3(3.0)) - vec3(1.0), real(0.0), real(1.0));
  return (vec3(real(0.3)) + circle * real(0.7)) * brightness;
}
