#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "app/base/error.h"
#include "app/picture/image_file.h"

namespace trisect {

void write_png(const Frame& frame, const AtomicFile& file) {
  std::vector<uint8_t> bytes;
  bytes.reserve(frame.colors.size() * 3);
  for (const vec4& color : frame.colors) {
    for (int i = 0; i < 3; ++i) {
      bytes.push_back(static_cast<uint8_t>(std::lround(std::clamp(color[i], 0.0F, 1.0F) * 255.0F)));
    }
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = frame.width;
  image.height = frame.height;
  image.format = PNG_FORMAT_RGB;  // eight bits a component, which libpng marks as sRGB
  if (png_image_write_to_file(&image, file.temporary().c_str(), 0, bytes.data(), 0, nullptr) == 0) {
    throw InputError(fmt::format("{}: could not be written: {}.", file.target().string(),
                                 static_cast<const char*>(image.message)));
  }
}

}  // namespace trisect
