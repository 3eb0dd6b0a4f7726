// The thesis's look: a sky gradient behind, Lambert shading with a grid in world space in front. The numbers
// are those that the thesis's window shows as they are: sRGB-encoded, not linear light.

vec3 sky(vec3 view) {
  return mix(vec3(1.0, 0.7, 0.5), vec3(0.8, 0.9, 1.0), sqrt(abs(view.y)));
}

real Lambert(vec3 normal, vec3 light) { return max(dot3(normalize3(normal), light), real(0.0)); }

// 0 on the planes of a grid of unit cells, 1 away from them; the lines are a tenth of a cell wide.
// The listing's function is lost; it enters the colour as 0.25 * grid beside a constant 0.5.
real ShadeGrid(vec3 pos) {
  vec3 away = abs(fract(pos) - real(0.5));
  real nearest = real(0.5) - max(max(away.x, away.y), away.z);
  return clamp((nearest - real(0.03)) / real(0.02), real(0.0), real(1.0));
}

vec3 shade(vec3 normal, vec3 pos, vec3 light, vec4 grid) {
  real f = Lambert(normal, light);
  real g = ShadeGrid((pos - vec3(grid)) * grid.w);
  return vec3((real(0.5) + g * real(0.25)) * f + real(0.25));
}
