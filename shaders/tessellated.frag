#version 450
// Shades a pixel of a tessellated patch as if a ray had hit the curved patch at the interpolated weights.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"
#include "frame_buffers.glsl"

in vec3 weights;
in vec3 from_eye;
flat in uint triangle;

#include "rays.glsl"
#include "every_candidate.glsl"
#include "trace.glsl"
#include "fragment_outputs.glsl"

void main() {
  PixelRay ray = pixel_ray(fragment_pixel(0u));
  Hit hit;
  hit.z = length3(from_eye);
  hit.weights = weights;
  hit.triangle = triangle;
  hit.subpatch = 0u;
  vec4 color;
  PixelAovs aovs;
  shade_pixel(ray, hit, color, aovs);
  write_fragment(color, aovs);
}
