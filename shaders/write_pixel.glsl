// A pixel's ray and its outputs. In the shadow pass (SHADOWS) the rays start from the hits of the camera rays, which are
// read from the outputs of the pass before.
#include "shadow.glsl"

layout(std430, binding = BINDING_COLOR) writeonly restrict buffer ColorBlock { vec4 colors[]; };
layout(std430, binding = BINDING_AOVS) restrict buffer AovsBlock { PixelAovs pixels[]; };

// The index of a pixel in the outputs, which begin with the band's first row. A pixel outside of the image gets the index of
// the nearest one within it.
uint output_index(uvec2 pixel) {
  uint row = min(pixel.y, params.height - 1u) - push.first_row;
  return row * params.width + min(pixel.x, params.width - 1u);
}

// The ray of a pixel: its camera ray, or in the shadow pass its shadow ray.
PixelRay ray_of(uvec2 pixel) {
  PixelRay ray = pixel_ray(pixel);
  if (!SHADOWS) return ray;
  return shadow_ray(pixels[output_index(pixel)], ray.view);
}

Traversal begin_pixel_traversal(uvec2 pixel, int steps) {
  if (!SHADOWS) return begin_traversal(steps);
  return begin_shadow_traversal(pixels[output_index(pixel)], pixel_ray(pixel).view, steps);
}

// Writes the outputs of a pixel whose traversal is finished.
void write_pixel(uvec2 pixel, PixelRay ray, Traversal traversal) {
  uint index = output_index(pixel);
  if (SHADOWS) {
    if (traversal.hit.triangle != NO_TRIANGLE) colors[index] = shadow_color(pixels[index], pixel_ray(pixel).view);
    if (COUNTS) {
      pixels[index].evaluations += traversal.counts.evaluations;
      pixels[index].candidates += traversal.counts.candidates;
    }
    return;
  }
  precise vec4 color;
  precise PixelAovs aovs;
  finish_pixel(ray, traversal, color, aovs);
  colors[index] = color;
  if (AOVS) pixels[index] = aovs;
}
