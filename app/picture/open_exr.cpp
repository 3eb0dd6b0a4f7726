#include "app/picture/open_exr.h"

#include <ImfHeader.h>
#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>

#include "app/base/message.h"
#include "app/frame/image_part.h"

namespace trisect {
namespace {

// Refuses a file whose header claims an attribute that is larger than the file, for which OpenEXR
// would take memory: each is a name, a type, a size and so many bytes, and an empty name ends them.
// Other mistakes are left to OpenEXR.
void expect_attributes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff end = file.tellg();
  constexpr std::streamoff magic_and_version = 8;
  file.seekg(magic_and_version);
  std::string name;
  std::string type;
  int32_t size = 0;
  while (std::getline(file, name, '\0') && !name.empty() && std::getline(file, type, '\0') &&
         file.read(reinterpret_cast<char*>(&size), sizeof(size))) {
    if (size < 0 || size > end - file.tellg()) {
      throw std::runtime_error("its header is damaged or cut off");
    }
    file.seekg(size, std::ios::cur);
  }
}

}  // namespace

Imf::InputFile open_exr(const std::filesystem::path& path) {
  [[maybe_unused]] static const bool is_limited = [] {
    constexpr int largest{kLargestSide};
    Imf::Header::setMaxImageSize(largest, largest);
    Imf::Header::setMaxTileSize(largest, largest);
    return true;
  }();
  expect_attributes(path);
  return Imf::InputFile(path.c_str());
}

InputError unreadable(const std::filesystem::path& path, std::string why) {
  const std::string named = fmt::format("image file \"{}\". ", path.string());
  if (const std::size_t at = why.find(named); at != std::string::npos) {
    why.erase(0, at + named.size());
  }
  return InputError(fmt::format("{}: could not be read: {}.", path.string(), reason_of(why)));
}

}  // namespace trisect
