// Specialisation constants, buffers and push constants of the kernels that cast rays from a buffer.

layout(constant_id = CONSTANT_SURFACE) const uint SURFACE = SURFACE_PHONG;
layout(constant_id = CONSTANT_SHELL) const uint SHELL = SHELL_NORMAL;
layout(constant_id = CONSTANT_DIVIDED) const bool DIVIDED = false;
layout(constant_id = CONSTANT_NONSMOOTH) const bool MAY_BE_NONSMOOTH = false;
layout(constant_id = CONSTANT_SOLVER) const uint SOLVER = SOLVER_ROBUST;
const bool AOVS = false;
const bool COUNTS = true;
const bool SHADOWS = false;

layout(std140, binding = BINDING_PARAMS) uniform ParamsBlock { TraceParams params; };
#include "scene_buffers.glsl"
layout(std430, binding = BINDING_RAYS) readonly restrict buffer RaysBlock { CastRay rays[]; };
layout(std430, binding = BINDING_HITS) writeonly restrict buffer HitsBlock { CastHit hits[]; };
layout(push_constant) uniform PushBlock { CastPush push; };
