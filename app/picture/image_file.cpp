#include "app/picture/image_file.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "app/base/error.h"

namespace trisect {

ImageFormat image_format(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".png") return ImageFormat::png;
  if (ending == ".exr") return ImageFormat::exr;
  throw UsageError(path.string() + ": an image's name must end in .png or .exr.");
}

void write_image(const Frame& frame, ImageFormat format, const AtomicFile& file,
                 const ImageContents& contents) {
  if (format == ImageFormat::png) {
    write_png(frame, file, contents.alpha);
  } else {
    write_exr(frame, contents.evals, file, contents.attributes);
  }
}

void save_image(const Frame& frame, const std::filesystem::path& path, bool evals) {
  const ImageFormat format = image_format(path);
  AtomicFile file(path);
  write_image(frame, format, file, {.evals = evals});
  file.commit();
}

}  // namespace trisect
