#version 450
// Does each operation on floats once for each item, for `trisect devices --floats`, which judges the results.
#extension GL_GOOGLE_include_directive : require
#include "float_operations.h"

layout(local_size_x = FLOATS_SIZE) in;

layout(std430, binding = FLOATS_INPUTS) readonly restrict buffer InputsBlock { uint inputs[]; };
layout(std430, binding = FLOATS_FLOAT_INPUTS) readonly restrict buffer FloatInputsBlock { float float_inputs[]; };
layout(std430, binding = FLOATS_RESULTS) writeonly restrict buffer ResultsBlock { uint results[]; };
layout(std430, binding = FLOATS_COPIES) writeonly restrict buffer CopiesBlock { float copies[]; };
layout(push_constant) uniform PushBlock { FloatsPush push; };

void put(uint item, uint result, float value) { results[item * FLOAT_RESULTS + result] = floatBitsToUint(value); }

uint tests_of(float a, float b) {
  uint tests = 0u;
  if (isnan(a)) tests |= FLOAT_IS_NAN;
  if (isinf(a)) tests |= FLOAT_IS_INF;
  if (a != a) tests |= FLOAT_DIFFERS;
  if (a == b) tests |= FLOAT_EQUAL;
  if (a < b) tests |= FLOAT_LESS;
  if (a >= b) tests |= FLOAT_AT_LEAST;
  if (!(a < b)) tests |= FLOAT_NOT_LESS;
  if (!(a >= b)) tests |= FLOAT_NOT_AT_LEAST;
  return tests;
}

void main() {
  uint item = gl_GlobalInvocationID.x;
  uint bits = inputs[3u * item];
  float a = uintBitsToFloat(bits);
  float b = uintBitsToFloat(inputs[3u * item + 1u]);
  float c = uintBitsToFloat(inputs[3u * item + 2u]);

  float sum = a + b;
  float difference = a - b;
  float product = a * b;
  float quotient = a / b;
  float root = sqrt(a);
  float inverse_root = inversesqrt(a);
  float fused = fma(a, b, c);
  float multiply_add = a * b + c;
  put(item, FLOAT_ADD, sum);
  put(item, FLOAT_SUBTRACT, difference);
  put(item, FLOAT_MULTIPLY, product);
  put(item, FLOAT_DIVIDE, quotient);
  put(item, FLOAT_SQRT, root);
  put(item, FLOAT_INVERSESQRT, inverse_root);
  put(item, FLOAT_FMA, fused);
  put(item, FLOAT_MULTIPLY_ADD, multiply_add);

  // The same division, of numbers of which the compiler cannot know that they are the same.
  float other_a = uintBitsToFloat(bits + push.zero);
  float other_b = uintBitsToFloat(inputs[3u * item + 1u] + push.zero);
  float quotient_again = other_a / other_b;
  vec3 quotients = vec3(c, other_a, 1.0) / other_b;
  float reciprocal = 1.0 / b;
  put(item, FLOAT_DIVIDE_AGAIN, quotient_again);
  put(item, FLOAT_DIVIDE_VECTOR, quotients.y);
  put(item, FLOAT_RECIPROCAL_VECTOR, quotients.z);
  put(item, FLOAT_RECIPROCAL, reciprocal);

  float minus_itself = a - a;
  float times_zero = a * 0.0;
  float plus_zero = a + 0.0;
  put(item, FLOAT_MIN, min(a, b));
  put(item, FLOAT_MAX, max(a, b));
  put(item, FLOAT_MINUS_ITSELF, minus_itself);
  put(item, FLOAT_TIMES_ZERO, times_zero);
  put(item, FLOAT_PLUS_ZERO, plus_zero);
  put(item, FLOAT_BITS, a);
  results[item * FLOAT_RESULTS + FLOAT_TESTS] = tests_of(a, b);
  for (uint k = 0u; k < 3u; ++k) copies[3u * item + k] = float_inputs[3u * item + k];
}
