// The baked numbers in double precision, for the shaders' mathematics there.
#pragma once

#include "app/surface/shared.h"
#include "app/surface/surface_choice.h"
#include "app/surface/surface_double.h"

namespace trisect {

// The choice that kernels make of this one: they have alpha in single precision.
SurfaceChoice with_single_alpha(const SurfaceChoice& choice);

in_double::Shape shape_of(const SurfaceChoice& choice);

// Every number is kept exactly.
in_double::Triangle to_double(const Triangle& tri);

}  // namespace trisect
