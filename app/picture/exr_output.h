// EXR files, written so that no failure is lost.
#pragma once

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>

#include <cstdint>
#include <functional>

#include "app/base/atomic_file.h"

namespace trisect {

// The pixels of so many rows from one of them on, 0 for the first of the header's data window; they
// need to be there until the next call. It is called from the top down: if the header's line order
// is another than that, which it begins with, the rows that are written are others.
using ExrRows = std::function<Imf::FrameBuffer(uint32_t first, uint32_t count)>;

// Writes all pixels of the header's data window, a band of rows after the other. Throws InputError,
// naming the file's target, if anything of it could not be written, and what a lack of memory
// throws.
void write_exr_rows(const Imf::Header& header, const ExrRows& rows, const AtomicFile& file);

}  // namespace trisect
