#version 450
// The surface at the corners of the flat triangles that it is divided into: the standard practice of rasterisers.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"
#include "frame_buffers.glsl"

layout(triangles, equal_spacing, ccw) in;

uniform mat4 camera;  // view and projection of points relative to the eye
uniform uint first;   // triangle of the draw

out vec3 weights;
out vec3 from_eye;
// Mesa counts gl_PrimitiveID anew in fragment shaders.
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
