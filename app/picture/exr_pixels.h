// The pixels of EXR files.
#pragma once

#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>

namespace trisect {

// Reads all pixels of the file's data window. OpenEXR takes a block of rows or a tile for whole
// whatever its bytes unpack to, if it is stored as it is or compressed by runs or by zlib, and
// gives what was in memory for the rest: such a file is refused. Throws std::runtime_error, and
// what OpenEXR throws.
void read_pixels(Imf::InputFile& file, const Imf::FrameBuffer& slices);

}  // namespace trisect
