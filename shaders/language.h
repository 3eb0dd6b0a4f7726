// The shaders that carry the mathematics are written in the common subset of GLSL and of C++ with
// GLM: `real` is the scalar type, literals are real(0.5), out-parameters are OUT(T), vectors are
// built by constructors and read by .x .y .z. app/surface/surface_double.h gives the C++ side of
// these names.
#ifdef TRISECT_ADDRESSES
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#endif
#define real float
// A variable whose value is rounded as written: Mesa's OpenGL compiler balances longer sums and
// products otherwise.
#define EXACT precise
#define OUT(T) out T
#define INOUT(T) inout T
