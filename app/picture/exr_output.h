// EXR files, written so that no failure is lost.
#pragma once

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>

#include "app/base/atomic_file.h"

namespace trisect {

// Writes all pixels of the header's data window. Throws InputError, naming the file's target, if
// anything of it could not be written, and what a lack of memory throws.
void write_exr_pixels(const Imf::Header& header, const Imf::FrameBuffer& pixels,
                      const AtomicFile& file);

}  // namespace trisect
