#version 450
// The thesis's renderer as a compute kernel: every pixel against every triangle of the storage buffer.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "shape.glsl"
#include "linear.glsl"
#include "surface.glsl"
#include "thesis_field.glsl"
#include "bisect.glsl"
#include "shading.glsl"

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;

layout(constant_id = CONSTANT_SURFACE) const uint SURFACE = SURFACE_PHONG;
layout(constant_id = CONSTANT_SHELL) const uint SHELL = SHELL_NORMAL;
layout(constant_id = CONSTANT_AOVS) const bool AOVS = false;

layout(std140, binding = BINDING_PARAMS) uniform ParamsBlock { TraceParams params; };
layout(std430, binding = BINDING_TRIANGLES) readonly restrict buffer TrianglesBlock {
  Triangle triangles[];
};
layout(std430, binding = BINDING_COLOR) writeonly restrict buffer ColorBlock { vec4 colors[]; };
layout(std430, binding = BINDING_AOVS) writeonly restrict buffer AovsBlock { PixelAovs aovs[]; };
layout(push_constant) uniform PushBlock { TilePush tile; };

void main() {
  uint groups_x = (params.width + TILE_SIZE - 1u) / TILE_SIZE;
  uint group = tile.first_group + gl_WorkGroupID.x;
  uvec2 pixel = uvec2(group % groups_x, group / groups_x) * TILE_SIZE + gl_LocalInvocationID.xy;
  if (pixel.x >= params.width || pixel.y >= params.height) return;

  // Through the pixel's centre, from the near plane to the far one.
  vec3 to_near = params.ray_corner.xyz + params.ray_dx.xyz * (float(pixel.x) + 0.5) +
                 params.ray_dy.xyz * (float(pixel.y) + 0.5);
  float near_distance = length3(to_near);
  vec3 view = to_near / near_distance;
  vec3 near_pos = params.eye.xyz + to_near;

  float cdepth = near_distance * (params.eye.w - 1.0);
  vec3 hit_weights = vec3(0.0);
  uint hit_triangle = NO_TRIANGLE;
  for (uint t = 0u; t < params.triangle_count; ++t) {
    float depth;
    vec3 weights;
    if (SURFACE == SURFACE_FLAT) {
      if (!hit_flat(triangles[t], near_pos, view, cdepth, depth, weights)) continue;
    } else {
      vec4 domain = triangles[t].Domain;
      vec2 bounds = rsi(near_pos - domain.xyz, view, domain.w);
      if (!chord_ahead(bounds)) continue;
      if (!bisect(Shape(SURFACE, SHELL, params.alpha), triangles[t], bounds, near_pos, view, int(params.rank), params.resolution,
                  params.min_delta, cdepth, depth, weights))
        continue;
    }
    cdepth = depth;
    hit_weights = weights;
    hit_triangle = t;
  }

  uint index = (pixel.y - tile.first_row) * params.width + pixel.x;
  bool hit = hit_triangle != NO_TRIANGLE;
  vec4 color = vec4(sky(view), 0.0);
  vec3 normal = vec3(0.0);
  if (hit) {
    normal = vertex_normal(triangles[hit_triangle], hit_weights);
    color = vec4(shade(normal, near_pos + view * cdepth, params.light.xyz, params.grid), 1.0);
  }
  colors[index] = color;
  if (AOVS) {
    PixelAovs aov;
    aov.normal_z = vec4(0.0);
    aov.geometric_u = vec4(0.0);
    aov.v = 0.0;
    aov.triangle = hit_triangle;
    aov.padding0 = 0u;
    aov.padding1 = 0u;
    if (hit) {
      aov.normal_z = vec4(normalize3(normal), near_distance + cdepth);
      aov.geometric_u = vec4(
          geometric_normal(Shape(SURFACE, SHELL, params.alpha), triangles[hit_triangle], hit_weights), hit_weights.y);
      aov.v = hit_weights.z;
    }
    aovs[index] = aov;
  }
}
