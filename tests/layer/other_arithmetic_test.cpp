// The rewriting of kernels by which tests emulate other devices.
#include "tests/layer/other_arithmetic.h"

#include <gtest/gtest.h>

#include <spirv-tools/libspirv.hpp>
#include <string>

#include "app/buffers/kernels.h"

namespace trisect::layer {
namespace {

std::string faults(const std::vector<uint32_t>& spirv) {
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1_SPIRV_1_4);
  std::string text;
  tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                               const char* message) { text += message; });
  return tools.Validate(spirv) ? std::string() : text + " (not valid)";
}

TEST(OtherArithmetic, LeavesModulesValid) {
  const OtherArithmetic all{true, 50, 32};
  for (const char* name :
       {"trace_list", "trace_tiles", "trace_packets_at", "trace_query", "project_subpatches"}) {
    const std::span<const uint32_t> spirv = spirv_of(name);
    const std::vector<uint32_t> other = with_other_arithmetic(spirv, all);
    EXPECT_EQ(faults(other), "") << name;
    EXPECT_GT(other.size(), spirv.size()) << name;
  }
}

TEST(OtherArithmetic, ChangesNothingUnasked) {
  const std::span<const uint32_t> spirv = spirv_of("trace_tiles");
  EXPECT_EQ(with_other_arithmetic(spirv, {}), std::vector<uint32_t>(spirv.begin(), spirv.end()));
}

}  // namespace
}  // namespace trisect::layer
