#include "app/difference_file.h"

#include "app/frame_comparison.h"
#include "app/image_file.h"

namespace trisect {

void write_difference(const Frame& a, const Frame& b, const std::string& path) {
  const ImageFormat format = image_format(path);
  AtomicFile file(path);
  const Frame picture = comparison_picture(a, b);
  if (format == ImageFormat::png) {
    write_png(picture, file);
  } else {
    write_exr(picture, false, file);
  }
  file.commit();
}

}  // namespace trisect
