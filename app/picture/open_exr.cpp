#include "app/picture/open_exr.h"

#include <ImfHeader.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "app/base/message.h"
#include "app/base/word_at.h"
#include "app/frame/image_part.h"

namespace trisect {
namespace {

// Types of values of one size, and their bytes: "OpenEXR File Layout", openexr.com.
constexpr std::array<std::pair<std::string_view, std::streamoff>, 24> kSizes{{
    {"box2f", 16},
    {"box2i", 16},
    {"chromaticities", 32},
    {"compression", 1},
    {"deepImageState", 1},
    {"double", 8},
    {"envmap", 1},
    {"float", 4},
    {"int", 4},
    {"keycode", 28},
    {"lineOrder", 1},
    {"m33d", 72},
    {"m33f", 36},
    {"m44d", 128},
    {"m44f", 64},
    {"rational", 8},
    {"tiledesc", 9},
    {"timecode", 8},
    {"v2d", 16},
    {"v2f", 8},
    {"v2i", 8},
    {"v3d", 24},
    {"v3f", 12},
    {"v3i", 12},
}};

// Whether a list of channels ends where its bytes do: names, each with 16 bytes, and an empty one.
bool is_channel_list(std::string_view bytes) {
  constexpr std::size_t of_channel = 16;
  while (!bytes.empty() && bytes[0] != '\0') {
    const std::size_t name = bytes.find('\0');
    if (name == std::string_view::npos || bytes.size() - name - 1 < of_channel) return false;
    bytes.remove_prefix(name + 1 + of_channel);
  }
  return bytes.size() == 1;
}

// Whether a small picture has the bytes for its pixels: width, height, and four each.
bool is_preview(std::string_view bytes) {
  if (bytes.size() < 8) return false;
  const std::size_t of_pixels = bytes.size() - 8;
  return of_pixels % 4 == 0 && uint64_t{word_at(bytes, 0)} * word_at(bytes, 4) == of_pixels / 4;
}

// Whether texts, each after its length, are as many bytes as there are.
bool is_list_of_texts(std::string_view bytes) {
  while (!bytes.empty()) {
    if (bytes.size() < 4) return false;
    const uint32_t length = word_at(bytes, 0);
    if (length > bytes.size() - 4) return false;
    bytes.remove_prefix(4 + length);
  }
  return true;
}

// Whether a value at the file's place, of so many bytes, can be one of its type. OpenEXR reads as
// many as the type has, whatever the file says, and takes for the next attribute what comes then.
bool has_size_of_type(std::ifstream& file, const std::string& type, std::streamoff size) {
  for (const auto& [name, bytes] : kSizes) {
    if (name == type) return size == bytes;
  }
  if (type == "floatvector") return size % 4 == 0;
  if (type != "chlist" && type != "preview" && type != "stringvector") return true;
  std::string bytes(static_cast<std::size_t>(size), '\0');
  file.read(bytes.data(), size);
  file.seekg(-size, std::ios::cur);
  if (type == "chlist") return is_channel_list(bytes);
  return type == "preview" ? is_preview(bytes) : is_list_of_texts(bytes);
}

}  // namespace

// Each attribute is a name, a type, a size and so many bytes; an empty name ends a header, an empty
// header those of a file of many parts.
std::streamoff end_of_headers(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff end = file.tellg();
  file.seekg(4);
  int version = 0;
  file.read(reinterpret_cast<char*>(&version), sizeof(version));
  std::string name;
  std::string type;
  int32_t size = 0;
  bool is_first = true;
  while (std::getline(file, name, '\0')) {
    if (name.empty()) {
      if (is_first || !Imf::isMultiPart(version)) return file.tellg();
      is_first = true;
      continue;
    }
    is_first = false;
    if (!std::getline(file, type, '\0') ||
        !file.read(reinterpret_cast<char*>(&size), sizeof(size))) {
      return end;
    }
    if (size < 0 || size > end - file.tellg() || !has_size_of_type(file, type, size)) {
      throw std::runtime_error("its header is damaged or cut off");
    }
    file.seekg(size, std::ios::cur);
  }
  return end;
}

Imf::InputFile open_exr(const std::filesystem::path& path) {
  [[maybe_unused]] static const bool is_limited = [] {
    constexpr int largest{kLargestSide};
    Imf::Header::setMaxImageSize(largest, largest);
    Imf::Header::setMaxTileSize(largest, largest);
    return true;
  }();
  end_of_headers(path);
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
