// The thesis's shading: a sky gradient for the background, Lambert shading with a grid in world space for the
// surface. Colours are sRGB-encoded as they stand, not linear light, because the thesis's window shows them unchanged.

vec3 sky(vec3 view) {
  real up = sqrt(abs(view.y));
  return vec3(1.0, 0.7, 0.5) * (real(1.0) - up) + vec3(0.8, 0.9, 1.0) * up;
}

real Lambert(vec3 normal, vec3 light) { return max(dot3(normalize3(normal), light), real(0.0)); }

// The distance along the surface to a plane at the distance `away`, where `facing` is the cosine between their normals. A
// plane almost parallel to the surface counts as far away, else a face that lies in it would be covered by its line.
real along_surface(real away, real facing) {
  real sine = sqrt(max(real(1.0) - facing * facing, real(0.0)));
  return sine > real(0.1) ? away / sine : real(1.0);
}

// 0 on the planes of a grid of unit cells, 1 away from them; the lines are a tenth of a cell wide. The thesis does not
// print this function, only how it enters the colour: 0.5 + 0.25 * grid.
real ShadeGrid(vec3 pos, vec3 normal) {
  vec3 away = real(0.5) - abs(fract(pos) - real(0.5));
  vec3 n = normalize3(normal);
  real nearest = min(min(along_surface(away.x, n.x), along_surface(away.y, n.y)), along_surface(away.z, n.z));
  return clamp((nearest - real(0.04)) / real(0.02), real(0.0), real(1.0));
}

// The colour of what the light does not reach.
const real AMBIENT = real(0.25);

vec3 shade(vec3 normal, vec3 pos, vec3 light, vec4 grid) {
  real f = Lambert(normal, light);
  real g = ShadeGrid((pos - vec3(grid)) * grid.w, normal);
  return vec3((real(0.5) + g * real(0.25)) * f + AMBIENT);
}
