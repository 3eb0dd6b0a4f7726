// Gives the chunks of PNG files the checksums that they should have, so that what lies behind the
// check of these is reached.
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

extern "C" std::size_t LLVMFuzzerMutate(uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

uint32_t big_endian(std::span<const uint8_t> four) {
  return uint32_t{four[0]} << 24U | uint32_t{four[1]} << 16U | uint32_t{four[2]} << 8U | four[3];
}

// Each chunk is a length, a name, so many bytes, and a checksum of the last two.
void mend_checksums(std::span<uint8_t> png) {
  constexpr std::size_t around = 12;
  png = png.subspan(8);
  while (png.size() >= around) {
    const std::size_t size = big_endian(png);
    if (size > png.size() - around) return;
    const auto sum = static_cast<uint32_t>(crc32(0, &png[4], static_cast<uInt>(size + 4)));
    for (unsigned i = 0; i < 4; ++i) {
      png[8 + size + i] = static_cast<uint8_t>(sum >> (24U - 8U * i));
    }
    png = png.subspan(size + around);
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned /*seed*/) {
  const std::size_t made = LLVMFuzzerMutate(data, size, max_size);
  constexpr uint8_t signature[] = {0x89, 'P', 'N', 'G'};
  for (std::size_t at = 1; at + 20 <= made; ++at) {
    if (std::equal(std::begin(signature), std::end(signature), data + at)) {
      mend_checksums({data + at, made - at});
      break;
    }
  }
  return made;
}
