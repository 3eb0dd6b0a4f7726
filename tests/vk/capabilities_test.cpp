// What a device can do, with the limits and subgroups of devices that are not here.
#include "vk/capabilities.h"

#include <gtest/gtest.h>

namespace trisect::gpu {
namespace {

// The least that Vulkan promises, but for the storage buffers in a stage: it promises four.
VkPhysicalDeviceLimits usual_limits() {
  VkPhysicalDeviceLimits limits{};
  limits.maxComputeWorkGroupInvocations = 128;
  limits.maxComputeWorkGroupSize[0] = 128;
  limits.maxComputeWorkGroupSize[1] = 128;
  limits.maxComputeWorkGroupSize[2] = 64;
  limits.maxComputeSharedMemorySize = 16384;
  limits.maxBoundDescriptorSets = 4;
  limits.maxPerStageDescriptorStorageBuffers = 16;
  limits.maxDescriptorSetStorageBuffers = 24;
  limits.maxPerStageDescriptorUniformBuffers = 12;
  limits.maxDescriptorSetUniformBuffers = 72;
  limits.maxPerStageResources = 128;
  limits.maxPushConstantsSize = 128;
  limits.maxStorageBufferRange = 1U << 27U;
  return limits;
}

TEST(UnmetNeeds, NameTheLimit) {
  EXPECT_TRUE(unmet_needs(usual_limits()).empty());
  VkPhysicalDeviceLimits limits = usual_limits();
  limits.maxPerStageDescriptorStorageBuffers = 4;
  limits.maxComputeSharedMemorySize = 512;
  EXPECT_EQ(unmet_needs(limits),
            (std::vector<std::string>{
                "1024 bytes of shared memory (maxComputeSharedMemorySize is 512)",
                "12 storage buffers in a stage (maxPerStageDescriptorStorageBuffers is 4)"}));
}

TEST(UnmetNeeds, LookAtEveryLimit) {
  // A device of which nothing is known has nothing.
  const std::vector<std::string> unmet = unmet_needs({});
  for (const char* limit :
       {"maxComputeWorkGroupInvocations", "maxComputeWorkGroupSize[0]",
        "maxComputeWorkGroupSize[1]", "maxComputeSharedMemorySize", "maxBoundDescriptorSets",
        "maxPerStageDescriptorStorageBuffers", "maxDescriptorSetStorageBuffers",
        "maxPerStageDescriptorUniformBuffers", "maxDescriptorSetUniformBuffers",
        "maxPerStageResources", "maxPushConstantsSize", "maxStorageBufferRange"}) {
    const std::string named = "(" + std::string(limit) + " is 0)";
    int times = 0;
    for (const std::string& text : unmet) times += text.find(named) != std::string::npos ? 1 : 0;
    EXPECT_EQ(times, 1) << limit;
  }
}

// Of a device that reports `size` and lets kernels ask for least to most.
SubgroupSupport support(uint32_t size, uint32_t least, uint32_t most) {
  return {size, least, most, true};
}

TEST(ChooseSubgroups, PrefersSixteenOrWhatIsNextToIt) {
  const auto best = [](const SubgroupSupport& s) { return choose_subgroups(s, std::nullopt); };
  EXPECT_EQ(best(support(32, 8, 32)), (SubgroupChoice{16, true, true}));   // Intel
  EXPECT_EQ(best(support(64, 32, 64)), (SubgroupChoice{32, true, true}));  // AMD
  EXPECT_EQ(best(support(32, 32, 32)), (SubgroupChoice{32, true, true}));  // NVIDIA
  EXPECT_EQ(best(support(8, 8, 8)), (SubgroupChoice{8, true, true}));      // lavapipe
  EXPECT_EQ(best(support(4, 4, 4)), (SubgroupChoice{4, true, true}));      // SwiftShader
}

TEST(ChooseSubgroups, LeavesTheSizeToTheDeviceWhereKernelsCannotAsk) {
  EXPECT_EQ(choose_subgroups(support(32, 0, 0), std::nullopt), (SubgroupChoice{32, false, true}));
  EXPECT_EQ(choose_subgroups({32, 0, 0, false}, std::nullopt), (SubgroupChoice{32, false, false}));
  EXPECT_FALSE(choose_subgroups(support(32, 0, 0), 32));
}

TEST(ChooseSubgroups, TakesTheSizeAskedForOrNone) {
  EXPECT_EQ(support(32, 8, 32).sizes(), (std::vector<uint32_t>{8, 16, 32}));
  for (const uint32_t size : {8U, 16U, 32U}) {
    EXPECT_EQ(choose_subgroups(support(32, 8, 32), size), (SubgroupChoice{size, true, true}));
  }
  for (const uint32_t size : {4U, 12U, 64U}) {
    EXPECT_FALSE(choose_subgroups(support(32, 8, 32), size)) << size;
  }
}

TEST(ChooseSubgroups, HasNoneWithoutTheOperations) {
  EXPECT_EQ(choose_subgroups({}, std::nullopt), SubgroupChoice{});
  EXPECT_EQ(choose_subgroups(support(32, 8, 32), 0), SubgroupChoice{});
  EXPECT_FALSE(choose_subgroups({}, 8));
}

}  // namespace
}  // namespace trisect::gpu
