// The colours of a frame: the surface's by TraceParams::shading, the sky or another colour behind it. They are sRGB-encoded
// as they stand, not linear light, because the thesis's window shows them unchanged. The sky, the grid in world space and
// Lambert's law are the thesis's.
#include "patch_color.glsl"

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

// Of the surface's colour, what the light does not reach keeps this much.
const real AMBIENT = real(0.25);

// A plain surface: Lambert's law in linear light, as a camera sees it, encoded by a root instead of sRGB's curve, which it
// follows to a twenty-fifth, and a highlight (Blinn 1977, "Models of light reflection for computer synthesized pictures"),
// for that tells most about a smooth surface. Light comes from all around, too, more of it from above, or shadows have no
// shape. normal, view: of unit length.
real ambient_light(vec3 normal) { return real(0.1) + real(0.06) * normal.y; }

vec3 plain(vec3 normal, vec3 view, vec3 light, vec3 color) {
  vec3 n = normalize3(normal);
  real lambert = max(dot3(n, light), real(0.0));
  real highlight = lambert > real(0.0) ? max(dot3(n, normalize3(light - view)), real(0.0)) : real(0.0);
  for (int i = 0; i < 5; ++i) highlight *= highlight;
  return color * sqrt(ambient_light(n) + real(0.84) * lambert) + vec3(real(0.3) * highlight);
}

vec3 with_grid(vec3 normal, vec3 pos, vec3 light, vec4 grid, vec3 color) {
  real f = Lambert(normal, light);
  real g = ShadeGrid((pos - vec3(grid)) * grid.w, normal);
  return color * ((real(0.5) + g * real(0.25)) * f + AMBIENT);
}
