// Reads back what write_exr wrote.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/frame/frame.h"

namespace trisect::test {

// The frame of an EXR file with all of trisect's channels. Colours are linear light, as in the
// file.
Frame read_exr(const std::filesystem::path& path);

// The names of a file's channels, each with its type: "float", "uint" or "half".
std::map<std::string, std::string> exr_channels(const std::filesystem::path& path);

// The values of a channel, row by row.
std::vector<double> exr_channel(const std::filesystem::path& path, const std::string& channel);

// x and y of red, green, blue and white that a file names; empty if it names none.
std::vector<float> exr_chromaticities(const std::filesystem::path& path);

}  // namespace trisect::test
