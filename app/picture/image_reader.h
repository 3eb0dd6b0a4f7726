// Frames from image files.
#pragma once

#include <filesystem>

#include "app/frame/frame.h"

namespace trisect {

// Reads a PNG, or an EXR with channels R, G and B; if an EXR has all of trisect's other channels
// the frame has AOVs. Colours come back sRGB-encoded, as in a rendered frame; a file without alpha
// counts as hit everywhere. Throws InputError, naming the file, and UsageError for an unknown
// ending.
Frame read_image(const std::filesystem::path& path);

}  // namespace trisect
