// Specialisation constants, push constants, parameters and scene of the shaders that make a frame. OpenGL has no
// specialisation constants in GLSL: app/opengl/shader_head.cpp defines their values ahead of this text. It has no push
// constants: a buffer takes their place.
#ifdef TRISECT_OPENGL
const uint SURFACE = VALUE_SURFACE;
const uint SHELL = VALUE_SHELL;
const bool DIVIDED = VALUE_DIVIDED != 0u;
const bool MAY_BE_NONSMOOTH = VALUE_NONSMOOTH != 0u;
const uint SOLVER = VALUE_SOLVER;
const bool AOVS = VALUE_AOVS != 0u;
const bool COUNTS = VALUE_COUNTS != 0u;
const bool SHADOWS = VALUE_SHADOWS != 0u;
layout(std430, binding = BINDING_PUSH) readonly restrict buffer PushBlock { TilePush push; };
#else
layout(constant_id = CONSTANT_SURFACE) const uint SURFACE = SURFACE_PHONG;
layout(constant_id = CONSTANT_SHELL) const uint SHELL = SHELL_NORMAL;
layout(constant_id = CONSTANT_DIVIDED) const bool DIVIDED = false;
layout(constant_id = CONSTANT_NONSMOOTH) const bool MAY_BE_NONSMOOTH = false;
layout(constant_id = CONSTANT_SOLVER) const uint SOLVER = SOLVER_ROBUST;
layout(constant_id = CONSTANT_AOVS) const bool AOVS = false;
layout(constant_id = CONSTANT_COUNTS) const bool COUNTS = false;
layout(constant_id = CONSTANT_SHADOWS) const bool SHADOWS = false;
layout(push_constant) uniform PushBlock { TilePush push; };
#endif

layout(std140, binding = BINDING_PARAMS) uniform ParamsBlock { TraceParams params; };
#include "scene_buffers.glsl"

// The pixel of invocation i within its tile. Each 8 consecutive invocations are a block of 4 x 2 pixels, 16 of 8 x 2, 32 of
// 8 x 4: the rays of a subgroup are close together whatever its size.
uvec2 pixel_in_tile(uint i) { return uvec2((i & 3u) | ((i >> 1) & 4u), ((i >> 2) & 1u) | ((i >> 3) & 6u)); }

// The number of tiles that cover so many pixels of a row or a column.
uint tiles_across(uint pixels) { return (pixels + TILE_SIZE - 1u) / TILE_SIZE; }

// The pixel of the image that invocation i has in this tile, which is numbered in raster order.
uvec2 pixel_of_tile(uint tile, uint i) {
  uint columns = tiles_across(params.width);
  return uvec2(tile % columns, tile / columns) * TILE_SIZE + pixel_in_tile(i);
}
