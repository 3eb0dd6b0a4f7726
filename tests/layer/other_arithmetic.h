// Rewrites a kernel's SPIR-V so that it computes as another device may: within what Vulkan allows,
// or beyond it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace trisect::layer {

struct OtherArithmetic {
  // Results of division, sqrt and inversesqrt are off by -2 to 2 ulp, always alike for the same
  // result. Zeros, denormals, infinities and NaNs stay.
  bool off_by_ulps = false;
  // Of the sums with a product, so many in a hundred become one fused operation: others in each
  // kernel, and whatever NoContraction says.
  uint32_t fused_percent = 0;
  // gl_SubgroupSize is this, and not what it was; 0: it stays.
  uint32_t subgroup_size = 0;
};

// spirv: a valid module of version 1.4 at most. Throws std::logic_error if it is cut off.
std::vector<uint32_t> with_other_arithmetic(std::span<const uint32_t> spirv,
                                            const OtherArithmetic& arithmetic);

}  // namespace trisect::layer
