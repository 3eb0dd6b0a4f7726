#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
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

}  // namespace

// Paul Debevec's format: a line each for the kind, the size and the scale, whose sign tells the
// order of the bytes (negative: the least significant first), then rows from the lowest up.
void write_pfm(const Frame& frame, const AtomicFile& file, const ImageContents& contents) {
  const Aov aov = contents.aovs.front();
  std::string bytes =
      fmt::format("{}\n{} {}\n-1.0\n", aov == Aov::depth ? "Pf" : "PF", frame.width, frame.height);
  for (uint32_t row = frame.height; row-- > 0;) {
    for (uint32_t column = 0; column < frame.width; ++column) {
      const std::size_t i = std::size_t{row} * frame.width + column;
      switch (aov) {
        case Aov::depth:
          append(frame.aovs.at(i).normal_z.w, bytes);
          break;
        case Aov::normal:
          append(glm::vec3(frame.aovs.at(i).normal_z), bytes);
          break;
        case Aov::geometric:
          append(glm::vec3(frame.aovs.at(i).geometric_u), bytes);
          break;
        case Aov::position:
          append(contents.positions.at(i), bytes);
          break;
        default:
          const vec4& color = frame.colors.at(i);
          append({linear_from_srgb(color.x), linear_from_srgb(color.y), linear_from_srgb(color.z)},
                 bytes);
      }
    }
  }
  file.write(bytes);
}

}  // namespace trisect
