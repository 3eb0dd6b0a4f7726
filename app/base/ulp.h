// Units in the last place of single precision.
#pragma once

namespace trisect {

// ULP(x) as the Vulkan specification has it: the least distance between two different floats a and
// b with a <= x <= b. x: finite, 0 too, of at most the largest float's size.
double ulp_of(double x);

// How far a float is from the exact result, in ulp_of(exact). Infinite if the float is a NaN or
// infinite. exact: finite.
double ulp_error(float result, double exact);

}  // namespace trisect
