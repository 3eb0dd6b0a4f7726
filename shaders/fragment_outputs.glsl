// The outputs of a fragment shader: a pixel's colour and AOVs, which app/opengl/frame_target.cpp reads back.

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_normal_z;
layout(location = 2) out vec4 out_geometric_u;
layout(location = 3) out uvec4 out_rest;  // bits of v, triangle, evaluations, candidates

// The pixel of the fragment, rows counted from the top. lowest: the row of the image, counted from the bottom, that the
// framebuffer's lowest row is.
uvec2 fragment_pixel(uint lowest) {
  return uvec2(uint(gl_FragCoord.x), params.height - 1u - lowest - uint(gl_FragCoord.y));
}

void write_fragment(vec4 color, PixelAovs aovs) {
  out_color = color;
  if (AOVS) {
    out_normal_z = aovs.normal_z;
    out_geometric_u = aovs.geometric_u;
    out_rest = uvec4(floatBitsToUint(aovs.v), aovs.triangle, aovs.evaluations, aovs.candidates);
  }
}
