// Whether all numbers of a baked scene are numbers.
#pragma once

#include <string>

#include "app/bake/bake.h"

namespace trisect::test {

// Names the first part of the scene, its subpatches and its tree among it, that holds a NaN or an
// infinity, or a number that gives one where kernels divide by it or square it. Empty if there is
// none.
std::string first_not_finite(const BakedScene& scene);

}  // namespace trisect::test
