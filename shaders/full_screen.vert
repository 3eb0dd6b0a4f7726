#version 450
// Two triangles that cover the image. Their corners are unprojected to the near plane by the double-precision
// inverse of the view-projection matrix, as in the thesis; the near points of the pixels are interpolated.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"

layout(std140, binding = BINDING_PARAMS) uniform ParamsBlock { TraceParams params; };
uniform dmat4 view_projection;  // for points relative to the eye

out vec3 to_near;
out vec2 across;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  dvec4 near = inverse(view_projection) * dvec4(corner, -1.0, 1.0);
  to_near = vec3(near.xyz / near.w);
  // Rows of the image count from the top, OpenGL's y from the bottom.
  across = 0.5 * vec2(corner.x * float(params.width) * params.frame_x.w,
                      -corner.y * float(params.height) * params.frame_y.w);
  gl_Position = vec4(corner, 0.0, 1.0);
}
