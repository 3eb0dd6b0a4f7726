// The bytes of PNG files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "app/base/atomic_file.h"
#include "app/frame/image_part.h"
#include "app/picture/image_file.h"

namespace trisect {

// What the keywords of texts begin with: programs take "background" alone, and others, for names of
// their own.
inline constexpr const char* kPngKeyword = "trisect:";

// Eight bits a component, sRGB, in rows from top to bottom.
struct PngPixels {
  uint32_t width = 0;
  uint32_t height = 0;
  bool alpha = false;  // four components a pixel, else three
  std::vector<uint8_t> bytes;
};

// The same, row by row.
struct PngRows {
  uint32_t width = 0;
  uint32_t height = 0;
  bool alpha = false;
  std::function<void(uint32_t row, uint8_t* bytes)> put;  // must not throw
};

// texts: names and values; the names get kPngKeyword before them. place: of a part of an image.
// Throws InputError, naming the file.
void write_png_rows(const PngRows& rows, const ImageTexts& texts,
                    const std::optional<FramePlace>& place, const AtomicFile& file);

// Sixteen bits a component, sRGB, from 0 to 65535, else as PngPixels.
struct PngValues {
  uint32_t width = 0;
  uint32_t height = 0;
  bool alpha = false;
  std::vector<uint16_t> values;
};

// These throw InputError, naming the file, if it cannot be read. Of 8 bits or 16, grey or with a
// palette, interlaced or not: colours that the file says are not sRGB become so, others stay as
// they are, 8 bits as 257 times their number.
PngValues read_png_values(const std::filesystem::path& path);
// Of 16 bits the nearest 8.
PngPixels read_png_pixels(const std::filesystem::path& path);
// The texts before the pixels whose names begin with kPngKeyword, without that.
ImageTexts read_png_texts(const std::filesystem::path& path);

}  // namespace trisect
