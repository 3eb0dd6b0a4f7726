// Blocks of rows and tiles that unpack to fewer bytes than their pixels have, for which OpenEXR
// gives what was in memory.
#include "app/picture/exr_pixels.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/picture/image_channels.h"
#include "app/picture/open_exr.h"
#include "tests/support/file_content.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

// Neither begins at 0 nor is a multiple of a block's rows or a tile's sides.
constexpr int kLeft = -3;
constexpr int kTop = -5;
constexpr int kWidth = 21;
constexpr int kHeight = 37;

Imath::Box2i window() {
  return {{kLeft, kTop}, {kLeft + kWidth - 1, kTop + kHeight - 1}};
}

// Values of a picture's two channels, and the places where OpenEXR reads and writes them.
struct Pixels {
  std::vector<float> red = std::vector<float>(std::size_t{kWidth} * kHeight);
  std::vector<float> green = red;

  Imf::FrameBuffer slices() {
    const auto slice = [&](std::vector<float>& values) {
      return Imf::Slice::Make(Imf::FLOAT, values.data(), window(), sizeof(float),
                              sizeof(float) * kWidth);
    };
    Imf::FrameBuffer buffer;
    buffer.insert("R", slice(red));
    buffer.insert("G", slice(green));
    return buffer;
  }
};

enum class Layout { rows, tiles, parts };

struct Kind {
  Imf::Compression compression;
  Layout layout;
};

// Alike in many places, so that every block is compressed, and no two rows alike.
Pixels some_pixels() {
  Pixels pixels;
  for (std::size_t i = 0; i < pixels.red.size(); ++i) {
    const std::size_t row = i / kWidth;
    pixels.red[i] = static_cast<float>(row);
    pixels.green[i] = i % kWidth < 4 ? 1.0F : 0.5F;
  }
  return pixels;
}

void write(const std::filesystem::path& path, const Kind& kind, Pixels pixels) {
  Imf::Header header(window(), window());
  header.compression() = kind.compression;
  header.channels().insert("R", Imf::Channel(Imf::FLOAT));
  header.channels().insert("G", Imf::Channel(Imf::FLOAT));
  if (kind.layout == Layout::tiles) {
    header.setTileDescription(Imf::TileDescription(8, 16, Imf::MIPMAP_LEVELS));
    Imf::TiledOutputFile file(path.c_str(), header);
    file.setFrameBuffer(pixels.slices());
    for (int level = 0; level < file.numLevels(); ++level) {
      file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
    }
  } else if (kind.layout == Layout::parts) {
    std::vector<Imf::Header> headers(2, header);
    for (std::size_t i = 0; i < headers.size(); ++i) {
      headers[i].setName("part " + std::to_string(i));
      headers[i].setType("scanlineimage");
    }
    Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 2);
    for (int i = 0; i < 2; ++i) {
      Imf::OutputPart part(file, i);
      part.setFrameBuffer(pixels.slices());
      part.writePixels(kHeight);
    }
  } else {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(pixels.slices());
    file.writePixels(kHeight);
  }
}

// What unpacks to so many bytes of 0.
std::string packed_zeros(Imf::Compression compression, std::size_t count) {
  if (compression == Imf::NO_COMPRESSION) return std::string(count, '\0');
  if (compression == Imf::RLE_COMPRESSION) return {static_cast<char>(count - 1), '\0'};
  const std::string zeros(count, '\0');
  uLongf size = compressBound(count);
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(zeros.data()), count);
  packed.resize(size);
  return packed;
}

// Writes the file with less in its block i than its pixels need. The blocks after it stay where
// they are.
void write_short_block(const std::filesystem::path& path, std::string bytes, const Kind& kind,
                       int i) {
  std::size_t head = kind.layout == Layout::tiles ? 16 : 4;
  if (kind.layout == Layout::parts) head += 4;
  uint64_t at = 0;
  std::memcpy(&at, bytes.data() + end_of_headers(path) + std::ptrdiff_t{8} * i, sizeof(at));
  const std::string packed = packed_zeros(kind.compression, 24);
  const auto size = static_cast<uint32_t>(packed.size());
  std::memcpy(bytes.data() + at + head, &size, sizeof(size));
  bytes.replace(at + head + sizeof(size), packed.size(), packed);
  std::ofstream(path, std::ios::binary) << bytes;
}

// Writes the file without the place of its block i.
void write_without_place(const std::filesystem::path& path, std::string bytes, int i) {
  std::memset(bytes.data() + end_of_headers(path) + std::ptrdiff_t{8} * i, 0, 8);
  std::ofstream(path, std::ios::binary) << bytes;
}

void expect_missing(const std::function<void()>& read_file, int block) {
  try {
    read_file();
    ADD_FAILURE() << "was read without its block " << block;
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "some of its pixels are missing") << block;
  }
}

TEST(ExrPixels, AreAllThere) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.exr";
  for (const Imf::Compression compression :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION}) {
    for (const Layout layout : {Layout::rows, Layout::tiles, Layout::parts}) {
      SCOPED_TRACE(std::to_string(compression) + " " + std::to_string(static_cast<int>(layout)));
      const Kind kind{compression, layout};
      const Pixels written = some_pixels();
      write(path, kind, written);
      Pixels read;
      const auto read_file = [&] {
        Imf::InputFile file = open_exr(path);
        read_pixels(file, read.slices());
      };
      read_file();
      EXPECT_EQ(read.red, written.red);
      EXPECT_EQ(read.green, written.green);

      const std::string bytes = test::content_of(path);
      const int last = layout == Layout::tiles               ? 3 * 3 - 1
                       : compression == Imf::ZIP_COMPRESSION ? (kHeight - 1) / 16
                                                             : kHeight - 1;
      for (const int block : {0, 1, last}) {
        write_short_block(path, bytes, kind, block);
        expect_missing(read_file, block);
        EXPECT_THROW(ImageChannels{path}, InputError) << block;
        write_without_place(path, bytes, block);
        expect_missing(read_file, block);
      }
    }
  }
}

// By these OpenEXR sees it itself.
TEST(ExrPixels, AreLeftToOpenExrWhereItCountsThem) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.exr";
  for (const Imf::Compression compression : {Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION,
                                             Imf::B44_COMPRESSION, Imf::DWAA_COMPRESSION}) {
    const Kind kind{compression, Layout::rows};
    write(path, kind, some_pixels());
    write_short_block(path, test::content_of(path), kind, 0);
    Imf::InputFile file = open_exr(path);
    Pixels read;
    EXPECT_ANY_THROW(read_pixels(file, read.slices())) << compression;
  }
}

}  // namespace
}  // namespace trisect
