// What a device's arithmetic on 32-bit floats does, measured: rounding, contraction, denormals, NaN
// and infinity.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "vk/device.h"

namespace trisect {

// The bits of three floats, on which each operation is tried.
struct FloatItem {
  uint32_t a = 0;
  uint32_t b = 0;
  uint32_t c = 0;
};

// Some thousand items, the same each time: numbers of all sizes, near powers of two, whose sums,
// products, quotients and roots lie near the middle of two floats or cancel, denormals, and all
// pairs of special values. A multiple of FLOATS_SIZE.
std::vector<FloatItem> float_items();

// The bits of the denormals that are sent through subgroups, each by a workgroup of its own.
std::vector<uint32_t> denormals_to_send();

// What the kernels of shaders/float_operations.h make of items, in their order.
struct FloatResults {
  std::vector<uint32_t> operations;  // FLOAT_RESULTS for each item
  std::vector<uint32_t> copies;      // the bits of three floats for each item
  std::vector<uint32_t> plain;       // bits of a * b + c that may be contracted
  // The bits of denormals_to_send() as the FLOATS_SIZE invocations of each one's workgroup got
  // them; empty if the device lacks subgroup operations.
  std::vector<uint32_t> broadcast;
};

// The largest error of an operation, in ulp of the exact result, among the items whose operands and
// exact results are 0 or normal numbers.
struct LargestError {
  std::size_t items = 0;
  double ulp = 0.0;
  FloatItem at;
};

// How often something is so.
struct Share {
  std::size_t yes = 0;
  std::size_t of = 0;

  void add(bool is_so) {
    ++of;
    if (is_so) ++yes;
  }
};

struct FloatReport {
  std::size_t items = 0;
  LargestError add;
  LargestError subtract;
  LargestError multiply;
  LargestError divide;  // by numbers from 2^-126 to 2^126, as Vulkan's promise has it
  LargestError sqrt;
  LargestError inversesqrt;
  LargestError fma;
  Share nearest_even;        // sums, differences and products rounded to nearest, ties to even
  Share fma_fused;           // of those of fma() where one rounding and two differ
  Share precise_contracted;  // a * b + c as with one rounding, of those where that differs
  Share plain_contracted;    // the same where it may be contracted
  Share division_repeats;    // quotients with the same bits wherever the kernel divides
  Share denormal_operands;   // sums and products that are not those of 0 instead
  Share denormal_results;    // sums and products that are denormals and not 0
  Share denormal_copies;     // denormals that a load and a store of floats leave as they are
  std::optional<Share> denormal_broadcast;  // the same of subgroupBroadcast, if there is such
  Share nan_tests;            // isnan, ==, <, >= and negations of NaN that are as IEEE 754 has them
  Share nan_results;          // sums, differences and products that are NaN where they should be
  Share nan_lost_by_min_max;  // min and max of a number and NaN that are the number
  Share infinities;           // tests, sums, differences and products that should be infinite
  Share division_by_zero;  // quotients by 0 of other numbers that are infinite, of the right sign
  Share signed_zeros;      // sums and products that are 0, of the right sign
  Share not_folded;  // a - a, a * 0 and a + 0 that are not 0, 0 and a where they should not be
  Share bits;        // floats of any bits that keep them on the way from uint to uint
};

// Judges what a device made of the items and of denormals_to_send().
FloatReport judge_floats(const std::vector<FloatItem>& items, const FloatResults& results);

// Runs the kernels on float_items(). Throws DeviceError if the device fails.
FloatReport measure_floats(const gpu::Device& device);

}  // namespace trisect
