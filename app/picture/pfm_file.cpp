#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <string>

#include "app/base/error.h"
#include "app/base/srgb.h"
#include "app/picture/image_file.h"

namespace trisect {
namespace {

void append(float value, std::string& bytes) {
  static_assert(std::endian::native == std::endian::little);
  char four[sizeof(value)];
  std::memcpy(four, &value, sizeof(value));
  bytes.append(four, sizeof(value));
}

void append(const glm::vec3& values, std::string& bytes) {
  for (int k = 0; k < 3; ++k) append(values[k], bytes);
}

void append_pixel(const Frame& frame, uint32_t x, uint32_t y, const ImageContents& contents,
                  std::string& bytes) {
  const std::size_t i = std::size_t{y} * frame.width + x;
  const vec4& color = frame.colors.at(i);
  switch (contents.aovs.front()) {
    case Aov::depth:
      return append(frame.aovs.at(i).normal_z.w, bytes);
    case Aov::normal:
      return append(glm::vec3(frame.aovs.at(i).normal_z), bytes);
    case Aov::geometric:
      return append(glm::vec3(frame.aovs.at(i).geometric_u), bytes);
    case Aov::position:
      return append(contents.position(x, y), bytes);
    default:
      append({linear_from_srgb(color.x), linear_from_srgb(color.y), linear_from_srgb(color.z)},
             bytes);
  }
}

}  // namespace

// Paul Debevec's format: a line each for the kind, the size and the scale, whose sign tells the
// order of the bytes (negative: the least significant first), then rows from the lowest up.
void write_pfm(const Frame& frame, const AtomicFile& file, const ImageContents& contents) {
  const Aov aov = contents.aovs.front();
  file.write_parts([&](std::ostream& out) {
    out << fmt::format("{}\n{} {}\n-1.0\n", aov == Aov::depth ? "Pf" : "PF", frame.width,
                       frame.height);
    std::string bytes;
    for (uint32_t row = frame.height; row-- > 0;) {
      bytes.clear();
      for (uint32_t column = 0; column < frame.width; ++column) {
        append_pixel(frame, column, row, contents, bytes);
      }
      out << bytes;
    }
  });
}

}  // namespace trisect
