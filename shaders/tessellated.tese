#version 450
// Evaluates the surface at the vertices of the tessellation, as rasterisers usually draw curved triangles.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"
#include "frame_buffers.glsl"

layout(triangles, equal_spacing, ccw) in;

uniform mat4 camera;  // view-projection matrix for points relative to the eye
uniform uint first;   // index of the draw's first triangle

out vec3 weights;
out vec3 from_eye;
// In fragment shaders Mesa's gl_PrimitiveID counts the tessellated triangles, so the index is passed on.
flat out uint triangle;

#include "rays.glsl"
#include "every_candidate.glsl"
#include "trace.glsl"

void main() {
  weights = gl_TessCoord;
  triangle = first + uint(gl_PrimitiveID);
  from_eye = surface_point(scene_shape(), triangles[triangle], weights) - vec3(params.eye);
  gl_Position = camera * vec4(from_eye, 1.0);
}
