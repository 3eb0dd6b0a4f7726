// What a frame's shaders are made for, and what they find bound. As OpenGL has no specialisation constants the
// program defines their values ahead of this text; as it has no push constants they are a buffer.
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

// A pixel of a tile: invocations next to each other see blocks of 4 x 2 pixels, then 8 x 2, 8 x 4.
uvec2 pixel_in_tile(uint i) { return uvec2((i & 3u) | ((i >> 1) & 4u), ((i >> 2) & 1u) | ((i >> 3) & 6u)); }

// Tiles that so many pixels of a row or a column touch.
uint tiles_across(uint pixels) { return (pixels + TILE_SIZE - 1u) / TILE_SIZE; }
