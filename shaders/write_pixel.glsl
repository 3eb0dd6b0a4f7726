// The outputs of a compute kernel.

layout(std430, binding = BINDING_COLOR) writeonly restrict buffer ColorBlock { vec4 colors[]; };
layout(std430, binding = BINDING_AOVS) writeonly restrict buffer AovsBlock { PixelAovs pixels[]; };

// Those of a pixel whose walk is through.
void write_pixel(uvec2 pixel, PixelRay ray, Walk walk) {
  precise vec4 color;
  precise PixelAovs aovs;
  finish_pixel(ray, walk, color, aovs);
  uint index = (pixel.y - push.first_row) * params.width + pixel.x;
  colors[index] = color;
  if (AOVS) pixels[index] = aovs;
}
