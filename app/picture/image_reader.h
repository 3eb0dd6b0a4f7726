// Frames from image files.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/frame/frame.h"

namespace trisect {

// Reads a PNG, or an EXR with channels R, G and B; if an EXR has all of trisect's other channels
// the frame has AOVs. Colours come back sRGB-encoded, as in a rendered frame; a file without alpha
// counts as hit everywhere. Throws InputError, naming the file, and UsageError for an unknown
// ending.
Frame read_image(const std::filesystem::path& path);

// What a PNG or EXR says of its picture in texts or attributes, as value_text() has it: name and
// value, of EXR those that write_exr() can write. Throws InputError and UsageError as read_image().
std::vector<std::pair<std::string, std::string>> read_attributes(const std::filesystem::path& path);

}  // namespace trisect
