#version 450
// a * b + c for each item, for `trisect devices --floats`. The only kernel in which the driver may contract it.
#extension GL_GOOGLE_include_directive : require
#include "float_operations.h"

layout(local_size_x = FLOATS_SIZE) in;

layout(std430, binding = FLOATS_INPUTS) readonly restrict buffer InputsBlock { uint inputs[]; };
layout(std430, binding = FLOATS_RESULTS) writeonly restrict buffer ResultsBlock { uint results[]; };

void main() {
  uint item = gl_GlobalInvocationID.x;
  float a = uintBitsToFloat(inputs[3u * item]);
  float b = uintBitsToFloat(inputs[3u * item + 1u]);
  float c = uintBitsToFloat(inputs[3u * item + 2u]);
  results[item] = floatBitsToUint(a * b + c);
}
