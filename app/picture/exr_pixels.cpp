#include "app/picture/exr_pixels.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfTileDescription.h>
#include <ImfVersion.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "app/base/word_at.h"
#include "app/picture/open_exr.h"

namespace trisect {
namespace {

// Bytes that the parts of a file's layout take ("OpenEXR File Layout", openexr.com).
constexpr std::streamoff kOffsetBytes = 8;
constexpr std::size_t kPartNumberBytes = 4;
constexpr std::size_t kRowBytes = 4;         // the first row of a block
constexpr std::size_t kTilePlaceBytes = 16;  // column, row and levels of a tile
constexpr std::size_t kSizeBytes = 4;

// Rows of a block; nothing for what OpenEXR itself takes for damaged if it unpacks to too little.
std::optional<int64_t> rows_in_block(Imf::Compression compression) {
  switch (compression) {
    case Imf::NO_COMPRESSION:
    case Imf::RLE_COMPRESSION:
    case Imf::ZIPS_COMPRESSION:
      return 1;
    case Imf::ZIP_COMPRESSION:
      return 16;
    default:
      return std::nullopt;
  }
}

// Of runs: a byte n < 128 and one to be repeated n + 1 times, or 256 - n and n bytes as they are.
std::size_t unpacked_from_runs(std::string_view packed) {
  std::size_t unpacked = 0;
  for (std::size_t at = 0; at < packed.size();) {
    const std::size_t n = static_cast<unsigned char>(packed[at]);
    const bool is_repeated = n < 128;
    const std::size_t count = is_repeated ? n + 1 : 256 - n;
    unpacked += count;
    at += is_repeated ? 2 : 1 + count;
  }
  return unpacked;
}

// Nothing if it is damaged, which OpenEXR tells.
std::optional<std::size_t> unpacked_by_zlib(std::string_view packed) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::array<Bytef, 65536> buffer{};
  int result = Z_OK;
  while (result == Z_OK) {
    stream.next_out = buffer.data();
    stream.avail_out = buffer.size();
    result = inflate(&stream, Z_NO_FLUSH);
  }
  const std::size_t unpacked = stream.total_out;
  inflateEnd(&stream);
  if (result != Z_STREAM_END) return std::nullopt;
  return unpacked;
}

std::optional<std::size_t> unpacked_size(Imf::Compression compression, std::string_view packed) {
  if (compression == Imf::NO_COMPRESSION) return packed.size();
  if (compression == Imf::RLE_COMPRESSION) return unpacked_from_runs(packed);
  return unpacked_by_zlib(packed);
}

// A file's blocks of rows, or the tiles of its first level, numbered from the top and the left.
class Blocks {
 public:
  Blocks(const Imf::Header& header, int64_t rows) : header_(header), rows_(rows) {
    const Imath::Box2i& window = header.dataWindow();
    width_ = int64_t{window.max.x} - window.min.x + 1;
    height_ = int64_t{window.max.y} - window.min.y + 1;
    if (!header.hasTileDescription()) return;
    columns_ = header.tileDescription().xSize;
    rows_ = header.tileDescription().ySize;
  }

  [[nodiscard]] bool are_tiles() const { return columns_ > 0; }

  [[nodiscard]] int64_t count() const { return (height_ + rows_ - 1) / rows_ * across(); }

  // Bytes that the i-th one unpacks to.
  [[nodiscard]] std::size_t bytes(int64_t i) const {
    const int64_t first_row = i / across() * rows_;
    const int64_t first_column = i % across() * columns_;
    const int64_t columns = are_tiles() ? std::min(columns_, width_ - first_column) : width_;
    const Imath::Box2i& window = header_.dataWindow();
    int64_t bytes = 0;
    const Imf::ChannelList& channels = header_.channels();
    for (auto at = channels.begin(); at != channels.end(); ++at) {
      const Imf::Channel& channel = at.channel();
      const int64_t across_block = samples(window.min.x + first_column, columns, channel.xSampling);
      const int64_t down = samples(window.min.y + first_row, std::min(rows_, height_ - first_row),
                                   channel.ySampling);
      bytes += across_block * down * (channel.type == Imf::HALF ? 2 : 4);
    }
    return static_cast<std::size_t>(bytes);
  }

 private:
  // How many of `count` pixels from `first` on are multiples of `every`.
  static int64_t samples(int64_t first, int64_t count, int64_t every) {
    const auto below = [&](int64_t end) {
      return end / every + (end % every > 0 ? 1 : 0);  // of those from 0 on; negative before it
    };
    return below(first + count) - below(first);
  }

  [[nodiscard]] int64_t across() const {
    return are_tiles() ? (width_ + columns_ - 1) / columns_ : 1;
  }

  const Imf::Header& header_;
  int64_t width_ = 0;
  int64_t height_ = 0;
  int64_t columns_ = 0;  // of a tile
  int64_t rows_;         // of a tile or a block of rows
};

[[noreturn]] void fail_incomplete() {
  throw std::runtime_error("some of its pixels are missing");
}

}  // namespace

// Mistakes of another kind are left to OpenEXR.
void expect_whole_blocks(const Imf::InputFile& file) {
  const Imf::Header& header = file.header();
  const Imf::Compression compression = header.compression();
  const std::optional<int64_t> rows = rows_in_block(compression);
  if (!rows) return;
  const Blocks blocks(header, *rows);
  const std::streamoff table = end_of_headers(file.fileName());
  const std::size_t head_bytes = (Imf::isMultiPart(file.version()) ? kPartNumberBytes : 0) +
                                 (blocks.are_tiles() ? kTilePlaceBytes : kRowBytes) + kSizeBytes;
  std::ifstream stream(file.fileName(), std::ios::binary);
  std::string head(head_bytes, '\0');
  std::string packed;
  for (int64_t i = 0; i < blocks.count(); ++i) {
    int64_t at = 0;
    stream.seekg(table + i * kOffsetBytes);
    if (!stream.read(reinterpret_cast<char*>(&at), sizeof(at))) return;
    if (at <= 0) fail_incomplete();
    stream.seekg(at);
    if (!stream.read(head.data(), static_cast<std::streamsize>(head.size()))) return;
    const std::size_t size = word_at(head, head.size() - kSizeBytes);
    const std::size_t whole = blocks.bytes(i);
    // What compression does not make smaller is stored as it is.
    if (size >= whole) continue;
    packed.resize(size);
    if (!stream.read(packed.data(), static_cast<std::streamsize>(size))) return;
    if (unpacked_size(compression, packed).value_or(whole) < whole) fail_incomplete();
  }
}

void read_pixels(Imf::InputFile& file, const Imf::FrameBuffer& slices) {
  expect_whole_blocks(file);
  read_known_pixels(file, slices);
}

void read_known_pixels(Imf::InputFile& file, const Imf::FrameBuffer& slices) {
  file.setFrameBuffer(slices);
  file.readPixels(file.header().dataWindow().min.y, file.header().dataWindow().max.y);
}

}  // namespace trisect
