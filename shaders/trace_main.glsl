// The main function of kernels that trace one ray per invocation: new rays in a frame's first pass, paused rays after it.
#include "workgroup_order.glsl"

// The tile in which a pixel lies, counted from the first tile of the band.
uint tile_of(uvec2 pixel) {
  return (pixel.y - push.first_row) / TILE_SIZE * tiles_across(params.width) + pixel.x / TILE_SIZE;
}

// The pixel of an invocation in the first pass. It may lie outside of the image, whose size need not be a multiple of the
// workgroup's.
uvec2 new_pixel() {
  uint group = GROUP_IN_TURN;
  uint columns = tiles_across(params.width);
  return uvec2(group % columns, group / columns) * TILE_SIZE + gl_LocalInvocationID.xy;
}

void main() {
  precise Traversal traversal = begin_traversal(int(state.now.steps));
  uvec2 pixel;
  if (state.now.pass == 0u) {
    pixel = new_pixel();
    if (pixel.x >= params.width || pixel.y >= params.height) return;
    traversal = begin_pixel_traversal(pixel, traversal.steps);
  } else {
    uint invocation = gl_WorkGroupID.x * TILE_SIZE * TILE_SIZE + gl_LocalInvocationIndex;
    if (invocation >= state.now.resumed) return;
    uint place = state.now.from + invocation;
    traversal = resumed_traversal(place, traversal.steps);
    uint index = paused[place].ray;
    pixel = uvec2(index % params.width, index / params.width);
  }
  precise PixelRay ray = ray_of(pixel);
  ray.tile = tile_of(pixel);
  resume(ray, state.now.pass, traversal);
  count_bytes(traversal);
  if (!is_finished(ray, traversal)) {
    enqueue(pixel.y * params.width + pixel.x, traversal);
    return;
  }
  write_pixel(pixel, ray, traversal);
}
