#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/base/error.h"
#include "app/base/message.h"
#include "app/base/srgb.h"
#include "app/picture/image_file.h"
#include "app/picture/png_pixels.h"

namespace trisect {
namespace {

uint8_t byte_of(float share) {
  return static_cast<uint8_t>(std::lround(std::clamp(share, 0.0F, 1.0F) * 255.0F));
}

// PNG's colours are not multiplied with A.
vec4 divided_by_alpha(const vec4& color) {
  if (color.w <= 0.0F || color.w >= 1.0F) return color;
  vec4 divided = color;
  for (int i = 0; i < 3; ++i) {
    divided[i] = srgb_from_linear(linear_from_srgb(color[i]) / color.w);
  }
  return divided;
}

// Keeps what libpng says is wrong, and goes back to setjmp().
void note_error(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp /*png*/, png_const_charp /*message*/) {}

[[noreturn]] void fail(const std::filesystem::path& path, const char* what,
                       const std::string& why) {
  throw InputError(fmt::format("{}: could not be {}: {}.", path.string(), what, reason_of(why)));
}

// A picture's rows and texts as libpng takes them.
struct PngContent {
  const PngRows& rows;
  const std::optional<FramePlace>& place;
  std::vector<uint8_t> row;
  std::vector<png_text> texts;
};

// No C++ object may live in here: after an error libpng jumps back into it.
void write_content(png_structp png, png_infop info, std::FILE* file, PngContent& content) {
  if (setjmp(png_jmpbuf(png)) != 0) return;  // NOLINT(cert-err52-cpp): as libpng has it
  png_init_io(png, file);
  png_set_IHDR(png, info, content.rows.width, content.rows.height, 8,
               content.rows.alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (content.place) {
    png_set_oFFs(png, info, static_cast<png_int_32>(content.place->x),
                 static_cast<png_int_32>(content.place->y), PNG_OFFSET_PIXEL);
  }
  png_set_text(png, info, content.texts.data(), static_cast<int>(content.texts.size()));
  png_write_info(png, info);
  for (uint32_t row = 0; row < content.rows.height; ++row) {
    content.rows.put(row, content.row.data());
    png_write_row(png, content.row.data());
  }
  png_write_end(png, info);
}

// The same of reading. These return nothing that C++ destroys.

void read_texts(png_structp png, png_infop info, std::FILE* file) {
  if (setjmp(png_jmpbuf(png)) != 0) return;  // NOLINT(cert-err52-cpp): as libpng has it
  png_init_io(png, file);
  png_read_info(png, info);
}

void read_rows(png_structp png, png_infop info, std::FILE* file) {
  if (setjmp(png_jmpbuf(png)) != 0) return;  // NOLINT(cert-err52-cpp): as libpng has it
  png_init_io(png, file);
  // The second is what the file has if it does not say.
  png_set_gamma(png, PNG_DEFAULT_sRGB, PNG_DEFAULT_sRGB);
  png_read_png(png, info,
               PNG_TRANSFORM_EXPAND_16 | PNG_TRANSFORM_GRAY_TO_RGB | PNG_TRANSFORM_SWAP_ENDIAN,
               nullptr);
}

// Refuses a file one of whose chunks is longer than the file, for which libpng would take memory:
// each is a length, the most significant byte first, a name, so many bytes, and a checksum. Other
// mistakes are left to libpng.
void expect_chunks(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff end = file.tellg();
  file.seekg(0);
  uint8_t head[8]{};
  auto* const at = reinterpret_cast<char*>(head);
  file.read(at, sizeof(head));
  if (png_sig_cmp(head, 0, sizeof(head)) != 0) return;
  while (file.read(at, sizeof(head)) && std::string_view(at + 4, 4) != "IEND") {
    std::streamoff length = 0;
    for (int i = 0; i < 4; ++i) length = length * 256 + head[i];
    if (length > end - file.tellg()) fail(path, "read", "it is cut off");
    file.seekg(length + 4, std::ios::cur);
  }
}

// A file as libpng has read it.
class PngReader {
 public:
  using Read = void (*)(png_structp, png_infop, std::FILE*);

  // Throws InputError.
  PngReader(const std::filesystem::path& path, Read read) {
    expect_chunks(path);
    std::FILE* stream = std::fopen(path.c_str(), "rb");
    if (stream == nullptr) complaint_ = std::generic_category().message(errno);
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &complaint_, note_error, ignore_warning);
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
    if (info_ == nullptr) complaint_ = "not enough memory";
    if (complaint_.empty()) read(png_, info_, stream);
    if (stream != nullptr) std::fclose(stream);
    if (complaint_.empty()) return;
    png_destroy_read_struct(&png_, &info_, nullptr);
    fail(path, "read", complaint_);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  PngReader(PngReader&&) = delete;
  PngReader& operator=(PngReader&&) = delete;

  [[nodiscard]] png_structp png() const { return png_; }
  [[nodiscard]] png_infop info() const { return info_; }

 private:
  std::string complaint_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

// Latin letters and signs go as they are, the rest as UTF-8.
png_text text_of(const std::string& name, const std::string& value) {
  const bool is_plain =
      std::all_of(value.begin(), value.end(), [](char c) { return c >= ' ' && c <= '~'; });
  png_text text{};
  text.compression = is_plain ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
  // libpng reads them only.
  text.key = const_cast<char*>(name.c_str());
  text.text = const_cast<char*>(value.c_str());
  return text;
}

// Whether a file can hold so many pixels: a byte of it unpacks to 1032 at most, of eight pixels
// each.
bool can_hold(const std::filesystem::path& path, uint32_t width, uint32_t height) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  constexpr std::uintmax_t most_packed = 1032;
  return error || std::uintmax_t{width} * height / 8 <= most_packed * bytes;
}

}  // namespace

void write_png_rows(const PngRows& rows, const ImageTexts& texts,
                    const std::optional<FramePlace>& place, const AtomicFile& file) {
  PngContent content{rows, place, {}, {}};
  content.row.resize(std::size_t{rows.width} * (rows.alpha ? 4 : 3));
  std::vector<std::string> keywords;
  keywords.reserve(texts.size());
  for (const auto& [name, value] : texts) {
    keywords.push_back(kPngKeyword + name);
    content.texts.push_back(text_of(keywords.back(), value));
  }

  std::string complaint;
  std::FILE* stream = std::fopen(file.temporary().c_str(), "wb");
  if (stream == nullptr) complaint = std::generic_category().message(errno);
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &complaint, note_error, ignore_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr) complaint = "not enough memory";
  if (complaint.empty()) write_content(png, info, stream, content);
  png_destroy_write_struct(&png, &info);
  // What is still in the stream's memory may not fit on the disk.
  if (stream != nullptr && std::fclose(stream) != 0 && complaint.empty()) {
    complaint = std::generic_category().message(errno);
  }
  if (!complaint.empty()) fail(file.target(), "written", complaint);
}

PngValues read_png_values(const std::filesystem::path& path) {
  const PngReader head(path, read_texts);
  const uint32_t width = png_get_image_width(head.png(), head.info());
  const uint32_t height = png_get_image_height(head.png(), head.info());
  if (!can_hold(path, width, height)) fail(path, "read", "it is cut off");
  // Up to four numbers of 16 bits a pixel, libpng's and ours.
  expect_pixels(width, height, 16, path.string());
  const PngReader file(path, read_rows);
  const bool alpha = png_get_channels(file.png(), file.info()) == 4;
  PngValues values{width, height, alpha, {}};
  const std::size_t row_values = std::size_t{width} * (alpha ? 4 : 3);
  values.values.resize(row_values * height);
  const png_bytepp rows = png_get_rows(file.png(), file.info());
  for (std::size_t y = 0; y < height; ++y) {
    std::memcpy(values.values.data() + y * row_values, rows[y], row_values * sizeof(uint16_t));
  }
  return values;
}

PngPixels read_png_pixels(const std::filesystem::path& path) {
  const PngValues values = read_png_values(path);
  PngPixels pixels{values.width, values.height, values.alpha, {}};
  pixels.bytes.reserve(values.values.size());
  for (const uint16_t value : values.values) {
    pixels.bytes.push_back(static_cast<uint8_t>((value + 128U) / 257U));
  }
  return pixels;
}

ImageTexts read_png_texts(const std::filesystem::path& path) {
  const PngReader file(path, read_texts);
  png_textp texts = nullptr;
  int count = 0;
  png_get_text(file.png(), file.info(), &texts, &count);
  ImageTexts found;
  const std::string_view keyword(kPngKeyword);
  for (int i = 0; i < count; ++i) {
    const std::string_view key(texts[i].key);
    if (key.starts_with(keyword)) found.emplace_back(key.substr(keyword.size()), texts[i].text);
  }
  return found;
}

void write_png(const Frame& frame, const AtomicFile& file, const ImageContents& contents) {
  const int components = contents.alpha ? 4 : 3;
  const auto put = [&](uint32_t row, uint8_t* bytes) {
    for (uint32_t column = 0; column < frame.width; ++column) {
      const vec4& pixel = frame.colors[std::size_t{row} * frame.width + column];
      const vec4 color = contents.alpha ? divided_by_alpha(pixel) : pixel;
      for (int i = 0; i < components; ++i) *bytes++ = byte_of(color[i]);
    }
  };
  write_png_rows({frame.width, frame.height, contents.alpha, put}, texts_of(contents.attributes),
                 contents.place, file);
}

}  // namespace trisect
