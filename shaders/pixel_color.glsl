// The colours that a frame's parameters ask for.

vec3 lit_color(uint triangle) {
  vec3 color = vec3(params.color);
  if (params.color.w > real(0.0) && triangles[triangle].Position[0].w >= real(0.0)) {
    color = vec3(triangles[triangle].Position[0].w, triangles[triangle].Position[1].w,
                 triangles[triangle].Position[2].w);
  }
  return color;
}

// What is seen along `view` of a hit: its shading normal, that on the side which is lit, its position and distance, its
// triangle.
vec3 surface_color(vec3 view, vec3 normal, vec3 lit, vec3 pos, real distance, uint triangle) {
  if (params.shading == SHADING_PLAIN) return plain(lit, view, vec3(params.light), lit_color(triangle));
  if (params.shading == SHADING_GRID) {
    return with_grid(lit, pos, vec3(params.light), params.grid, lit_color(triangle));
  }
  if (params.shading == SHADING_NORMAL) return vec3(0.5) + normalize3(normal) * real(0.5);
  if (params.shading == SHADING_PATCH) return patch_color(triangle);
  real depth = (distance - params.depth_low) / (params.depth_high - params.depth_low);
  return vec3(real(1.0) - clamp(depth, real(0.0), real(1.0)));
}

// The colour of a lit surface in shadow.
vec3 color_in_shadow(vec3 lit, uint triangle) {
  real left = params.shading == SHADING_PLAIN ? sqrt(ambient_light(lit)) : AMBIENT;
  return lit_color(triangle) * left;
}

vec3 background(vec3 view) {
  vec3 color = vec3(params.background);
  if (params.background.w > real(0.0)) color = sky(view);
  return color;
}
