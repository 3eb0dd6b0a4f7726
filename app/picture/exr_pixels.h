// The pixels of EXR files.
#pragma once

#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>

namespace trisect {

// Refuses a file of which a block of rows or a tile unpacks to fewer bytes than its pixels have, or
// has no place in the file's table. If it is stored as it is, or compressed by runs or by zlib,
// OpenEXR takes it for whole and gives what was in memory for the rest, and it looks for what has
// no place. Unpacks all of the file. Throws std::runtime_error.
void expect_whole_blocks(const Imf::InputFile& file);

// Reads all pixels of the data window of a file that was looked at so. Throws what OpenEXR throws.
void read_known_pixels(Imf::InputFile& file, const Imf::FrameBuffer& slices);

// Both.
void read_pixels(Imf::InputFile& file, const Imf::FrameBuffer& slices);

}  // namespace trisect
