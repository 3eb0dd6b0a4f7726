#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/base/error.h"
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
  throw InputError(fmt::format("{}: could not be {}: {}.", path.string(), what, why));
}

// A picture's rows and texts as libpng takes them.
struct PngContent {
  uint32_t width;
  uint32_t height;
  bool alpha;
  std::optional<FramePlace> place;
  std::vector<uint8_t*> rows;
  std::vector<png_text> texts;
};

// No C++ object may live in here: after an error libpng jumps back into it.
void write_content(png_structp png, png_infop info, std::FILE* file, PngContent& content) {
  if (setjmp(png_jmpbuf(png)) != 0) return;  // NOLINT(cert-err52-cpp): as libpng has it
  png_init_io(png, file);
  png_set_IHDR(png, info, content.width, content.height, 8,
               content.alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (content.place) {
    png_set_oFFs(png, info, static_cast<png_int_32>(content.place->x),
                 static_cast<png_int_32>(content.place->y), PNG_OFFSET_PIXEL);
  }
  png_set_text(png, info, content.texts.data(), static_cast<int>(content.texts.size()));
  png_set_rows(png, info, content.rows.data());
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
}

// The same of reading: the texts of a file.
void read_texts(png_structp png, png_infop info, std::FILE* file, png_textp* texts, int* count) {
  if (setjmp(png_jmpbuf(png)) != 0) return;  // NOLINT(cert-err52-cpp): as libpng has it
  png_init_io(png, file);
  png_read_info(png, info);
  png_get_text(png, info, texts, count);
}

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

// Whether a file can hold so many pixels: a byte of it unpacks to 1032 at most, of eight pixels
// each.
bool can_hold(const std::filesystem::path& path, const png_image& image) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  constexpr std::uintmax_t most_packed = 1032;
  return error || std::uintmax_t{image.width} * image.height / 8 <= most_packed * bytes;
}

}  // namespace

void write_png_pixels(PngPixels& pixels, const ImageTexts& texts,
                      const std::optional<FramePlace>& place, const AtomicFile& file) {
  PngContent content{pixels.width, pixels.height, pixels.alpha, place, {}, {}};
  const std::size_t row_bytes = std::size_t{pixels.width} * (pixels.alpha ? 4 : 3);
  for (uint32_t row = 0; row < pixels.height; ++row) {
    content.rows.push_back(pixels.bytes.data() + row * row_bytes);
  }
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

PngPixels read_png_pixels(const std::filesystem::path& path) {
  expect_chunks(path);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) {
    fail(path, "read", static_cast<const char*>(image.message));
  }
  if (!can_hold(path, image)) {
    png_image_free(&image);
    fail(path, "read", "it is cut off");
  }
  PngPixels pixels{image.width, image.height, (image.format & PNG_FORMAT_FLAG_ALPHA) != 0, {}};
  image.format = pixels.alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  pixels.bytes.resize(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, pixels.bytes.data(), 0, nullptr) == 0) {
    fail(path, "read", static_cast<const char*>(image.message));
  }
  return pixels;
}

ImageTexts read_png_texts(const std::filesystem::path& path) {
  expect_chunks(path);
  std::string complaint;
  std::FILE* stream = std::fopen(path.c_str(), "rb");
  if (stream == nullptr) complaint = std::generic_category().message(errno);
  png_structp png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, &complaint, note_error, ignore_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr) complaint = "not enough memory";
  png_textp texts = nullptr;
  int count = 0;
  if (complaint.empty()) read_texts(png, info, stream, &texts, &count);
  ImageTexts found;
  const std::string_view keyword(kPngKeyword);
  for (int i = 0; i < count; ++i) {
    const std::string_view key(texts[i].key);
    if (key.starts_with(keyword)) found.emplace_back(key.substr(keyword.size()), texts[i].text);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (stream != nullptr) std::fclose(stream);
  if (!complaint.empty()) fail(path, "read", complaint);
  return found;
}

void write_png(const Frame& frame, const AtomicFile& file, const ImageContents& contents) {
  const int components = contents.alpha ? 4 : 3;
  PngPixels pixels{frame.width, frame.height, contents.alpha, {}};
  pixels.bytes.reserve(frame.colors.size() * static_cast<std::size_t>(components));
  for (const vec4& pixel : frame.colors) {
    const vec4 color = contents.alpha ? divided_by_alpha(pixel) : pixel;
    for (int i = 0; i < components; ++i) pixels.bytes.push_back(byte_of(color[i]));
  }
  write_png_pixels(pixels, texts_of(contents.attributes), contents.place, file);
}

}  // namespace trisect
