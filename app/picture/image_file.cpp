#include "app/image_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "app/error.h"

namespace trisect {

ImageFormat image_format(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".png") return ImageFormat::png;
  if (ending == ".exr") return ImageFormat::exr;
  throw UsageError(path.string() + ": an image's name must end in .png or .exr.");
}

void write_image(const Frame& frame, ImageFormat format, bool evals, const AtomicFile& file) {
  if (format == ImageFormat::png) {
    write_png(frame, file);
  } else {
    write_exr(frame, evals, file);
  }
}

float linear_from_srgb(float encoded) {
  const auto x = static_cast<double>(encoded);
  return static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

float srgb_from_linear(float linear) {
  const auto x = static_cast<double>(linear);
  return static_cast<float>(x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
}

}  // namespace trisect
