#version 450
// Every triangle, a patch of one vertex, is divided alike.
layout(vertices = 1) out;

uniform float level;

void main() {
  gl_TessLevelInner[0] = level;
  gl_TessLevelOuter[0] = level;
  gl_TessLevelOuter[1] = level;
  gl_TessLevelOuter[2] = level;
}
