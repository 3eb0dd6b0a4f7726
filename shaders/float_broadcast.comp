#version 450
// Sends the a of a subgroup's first item, as a float, to all invocations of the subgroup, for `trisect devices --floats`:
// whether a denormal that is only moved stays what it is.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "float_operations.h"

layout(local_size_x = FLOATS_SIZE) in;

layout(std430, binding = FLOATS_FLOAT_INPUTS) readonly restrict buffer FloatInputsBlock { float float_inputs[]; };
layout(std430, binding = FLOATS_RESULTS) writeonly restrict buffer ResultsBlock { uint results[]; };

void main() {
  uint item = gl_GlobalInvocationID.x;
  results[item] = floatBitsToUint(subgroupBroadcast(float_inputs[3u * item], 0u));
}
