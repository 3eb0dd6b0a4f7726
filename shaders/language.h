// The shaders that carry the mathematics are written in the common subset of GLSL and of C++ with
// GLM: `real` is the scalar type, literals are real(0.5), out-parameters are OUT(T), vectors are
// built by constructors and read by .x .y .z. app/surface/surface_float.h and surface_double.h give
// the C++ side of these names.
#ifdef TRISECT_ADDRESSES
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#endif
#include "gamma.h"
#define real float
// gamma(n) of the scalar type.
#define GAMMA(n) GAMMA_SINGLE(real, n)
// A part of a slack that only a proof needs, which is made in double precision; 0 here.
#define FOR_PROOF(slack) real(0.0)
// The first value in single precision, the second in double.
#define BY_PRECISION(single_value, double_value) single_value
// A variable whose value is rounded as written: Mesa's OpenGL compiler balances longer sums and
// products otherwise.
#define EXACT precise
#define OUT(T) out T
#define INOUT(T) inout T
