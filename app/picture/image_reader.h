// Frames from image files.
#pragma once

#include <filesystem>

#include "app/frame/frame.h"

namespace trisect {

// A PNG, or an EXR with R, G and B and, if all of them are there, trisect's other channels. Colours
// are sRGB-encoded, as in a rendered frame; a file without alpha is hit everywhere. Throws
// InputError, naming the file.
Frame read_image(const std::filesystem::path& path);

}  // namespace trisect
