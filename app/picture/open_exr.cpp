#include "app/picture/open_exr.h"

#include <ImfHeader.h>

#include "app/frame/image_part.h"

namespace trisect {

Imf::InputFile open_exr(const std::filesystem::path& path) {
  [[maybe_unused]] static const bool is_limited = [] {
    constexpr int largest{kLargestSide};
    Imf::Header::setMaxImageSize(largest, largest);
    Imf::Header::setMaxTileSize(largest, largest);
    return true;
  }();
  return Imf::InputFile(path.c_str());
}

}  // namespace trisect
