// Rays aimed at where a closed model could leak.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace trisect::test {

struct Leaks {
  std::size_t rays = 0;
  std::size_t leaks = 0;      // no hit, or one behind, where the oracle has a decidable one
  std::size_t nans = 0;       // hits that are not numbers
  std::size_t suspects = 0;   // rays that the oracle was asked about
  std::size_t undecided = 0;  // of these
};

// Casts `count` rays on the validated device at an asset, its holes filled, in the normal shell: at
// points of its surface, within 1e-6 of its edges, at its edges and at its vertices, from outside
// and from inside.
Leaks count_leaks(const std::string& asset, uint32_t surface, std::size_t count, uint64_t seed);

}  // namespace trisect::test
