// The picture of how two frames differ, as a file.
#pragma once

#include <string>

#include "app/frame.h"

namespace trisect {

// Writes comparison_picture(a, b) to a .png or .exr file. Throws InputError or UsageError.
void write_difference(const Frame& a, const Frame& b, const std::string& path);

}  // namespace trisect
