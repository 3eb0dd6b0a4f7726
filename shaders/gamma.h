// Bounds of rounding errors, for GLSL and for C++.
//
// Every operation +, -, *, /, sqrt on floating-point numbers gives the exact result times 1 + d
// with |d| <= u, the unit roundoff, 2^-24 in single precision and 2^-53 in double, as long as
// nothing overflows or becomes denormal. A product of n such factors, or of their inverses, is 1 +
// t with |t| <= gamma(n) = n u / (1 - n u) for n u < 1 (Higham, "Accuracy and Stability of
// Numerical Algorithms", 2nd ed., lemma 3.1). A sum of products is therefore off by at most
// gamma(n) times the sum of the products' sizes, where n is the number of roundings that the
// longest of them goes through, however much cancels in it (section 3.1): a dot product of three
// terms by gamma(3) |a| |b|.
#define UNIT_ROUNDOFF_SINGLE 5.9604644775390625e-8
#define UNIT_ROUNDOFF_DOUBLE 1.1102230246251565e-16

// gamma(n) in the arithmetic of the type T: n is an integer. The numerator and the denominator are
// exact.
#define GAMMA_OF(T, n, u) (T(n) * T(u) / (T(1.0) - T(n) * T(u)))
#define GAMMA_SINGLE(T, n) GAMMA_OF(T, n, UNIT_ROUNDOFF_SINGLE)
#define GAMMA_DOUBLE(T, n) GAMMA_OF(T, n, UNIT_ROUNDOFF_DOUBLE)
