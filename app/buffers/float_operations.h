// shaders/float_operations.h for C++.
#pragma once

#include "app/surface/shared.h"

namespace trisect {

#include "shaders/float_operations.h"

}  // namespace trisect
