// Frames from image files.
#pragma once

#include <filesystem>

#include "app/frame/frame.h"
#include "app/picture/image_file.h"

namespace trisect {

// Reads a PNG, or an EXR with channels R, G and B; if an EXR has all of trisect's other channels
// the frame has AOVs. Colours come back sRGB-encoded, as in a rendered frame; a file without alpha
// counts as hit everywhere. Throws InputError, naming the file, and UsageError for an unknown
// ending.
Frame read_image(const std::filesystem::path& path);

// The texts of a PNG before its pixels, or the attributes of an EXR that write_exr() can write, as
// value_text() has them. Throws InputError and UsageError as read_image().
ImageTexts read_attributes(const std::filesystem::path& path);

}  // namespace trisect
