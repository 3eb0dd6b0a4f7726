#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "app/base/error.h"
#include "app/base/srgb.h"
#include "app/picture/image_file.h"

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

}  // namespace

void write_png(const Frame& frame, const AtomicFile& file, bool alpha) {
  std::vector<uint8_t> bytes;
  bytes.reserve(frame.colors.size() * (alpha ? 4 : 3));
  for (const vec4& pixel : frame.colors) {
    const vec4 color = alpha ? divided_by_alpha(pixel) : pixel;
    for (int i = 0; i < (alpha ? 4 : 3); ++i) bytes.push_back(byte_of(color[i]));
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = frame.width;
  image.height = frame.height;
  // Eight bits a component, which libpng marks as sRGB.
  image.format = alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  if (png_image_write_to_file(&image, file.temporary().c_str(), 0, bytes.data(), 0, nullptr) == 0) {
    throw InputError(fmt::format("{}: could not be written: {}.", file.target().string(),
                                 static_cast<const char*>(image.message)));
  }
}

}  // namespace trisect
