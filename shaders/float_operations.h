// What float_operations.comp is given and what it writes, for GLSL and for C++.
//
// Floats travel as their bits, so that nothing but the operations themselves can change them.

// Descriptor bindings, set 0.
#define FLOATS_INPUTS 0        // uint: three for each item, the bits of a, b and c
#define FLOATS_FLOAT_INPUTS 1  // the same buffer, as floats
#define FLOATS_RESULTS 2       // uint: FLOAT_RESULTS for each item; one for each of other kernels
#define FLOATS_COPIES 3        // float: a copy of each float input

struct FloatsPush {
  // 0, which the compiler cannot know: added to a number's bits it makes another number for it.
  uint zero;
};

// Items of a workgroup. There are as many as fill workgroups.
#define FLOATS_SIZE 64

// The results of an item.
const uint FLOAT_ADD = 0u;                 // a + b
const uint FLOAT_SUBTRACT = 1u;            // a - b
const uint FLOAT_MULTIPLY = 2u;            // a * b
const uint FLOAT_DIVIDE = 3u;              // a / b
const uint FLOAT_SQRT = 4u;                // sqrt(a)
const uint FLOAT_INVERSESQRT = 5u;         // inversesqrt(a)
const uint FLOAT_FMA = 6u;                 // fma(a, b, c)
const uint FLOAT_MULTIPLY_ADD = 7u;        // a * b + c
const uint FLOAT_DIVIDE_AGAIN = 8u;        // a / b from another place of the kernel
const uint FLOAT_DIVIDE_VECTOR = 9u;       // the second of vec3(c, a, 1) / b
const uint FLOAT_RECIPROCAL_VECTOR = 10u;  // the third of them
const uint FLOAT_RECIPROCAL = 11u;         // 1 / b
const uint FLOAT_MIN = 12u;                // min(a, b)
const uint FLOAT_MAX = 13u;                // max(a, b)
const uint FLOAT_MINUS_ITSELF = 14u;       // a - a
const uint FLOAT_TIMES_ZERO = 15u;         // a * 0
const uint FLOAT_PLUS_ZERO = 16u;          // a + 0
const uint FLOAT_BITS = 17u;               // the bits of a, as a float and back
const uint FLOAT_TESTS = 18u;              // the bits below
const uint FLOAT_RESULTS = 19u;

const uint FLOAT_IS_NAN = 1u;          // isnan(a)
const uint FLOAT_IS_INF = 2u;          // isinf(a)
const uint FLOAT_DIFFERS = 4u;         // a != a
const uint FLOAT_EQUAL = 8u;           // a == b
const uint FLOAT_LESS = 16u;           // a < b
const uint FLOAT_AT_LEAST = 32u;       // a >= b
const uint FLOAT_NOT_LESS = 64u;       // !(a < b)
const uint FLOAT_NOT_AT_LEAST = 128u;  // !(a >= b)
