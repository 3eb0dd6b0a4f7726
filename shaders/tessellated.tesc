#version 450
// A base triangle is a patch of one vertex; all are tessellated at the same level.
layout(vertices = 1) out;

uniform float level;

void main() {
  gl_TessLevelInner[0] = level;
  gl_TessLevelOuter[0] = level;
  gl_TessLevelOuter[1] = level;
  gl_TessLevelOuter[2] = level;
}
