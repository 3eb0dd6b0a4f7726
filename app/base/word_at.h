// Numbers in the bytes of binary files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace trisect {

// The little-endian number in the four bytes from `at` on, which must be there.
inline uint32_t word_at(std::string_view bytes, std::size_t at) {
  uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof(word));
  return word;
}

}  // namespace trisect
