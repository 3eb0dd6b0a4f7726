// A colour for a number, such that near numbers have distinct colours: the hue advances by the golden ratio, the brightness
// by another irrational number, both as fractions of 2^32, which large numbers keep.
real fraction_of_turn(uint number, uint step) { return real((number * step) >> 8) * real(5.9604644775390625e-8); }

vec3 patch_color(uint number) {
  real hue = fraction_of_turn(number, 2654435769u);
  real brightness = real(0.55) + real(0.45) * fraction_of_turn(number, 3242174889u);
  vec3 sixths = fract(vec3(hue) + vec3(0.0, 2.0, 1.0) / real(3.0)) * real(6.0);
  vec3 circle = clamp(abs(sixths - vec3(3.0)) - vec3(1.0), real(0.0), real(1.0));
  return (vec3(real(0.3)) + circle * real(0.7)) * brightness;
}
