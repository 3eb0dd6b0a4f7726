// EXR files, opened for reading.
#pragma once

#include <ImfInputFile.h>

#include <filesystem>

namespace trisect {

// Opens a file whose pixels are at most kLargestSide a side: a few bytes may claim more than the
// machine has memory for, and OpenEXR takes memory for a row at once. The limit is OpenEXR's own
// and from then on the process's. Throws what OpenEXR throws.
Imf::InputFile open_exr(const std::filesystem::path& path);

}  // namespace trisect
