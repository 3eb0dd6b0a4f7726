// The choice of a device, with reports of devices that do not exist.
#include <gtest/gtest.h>

#include "vk/instance.h"
#include "vk/result.h"

namespace trisect::gpu {
namespace {

DeviceReport device(const std::string& name, int rank, std::vector<std::string> lacks = {}) {
  return {name, "", "", "1.3.0", std::move(lacks), rank};
}

const std::vector<DeviceReport> kThree{device("llvmpipe (LLVM 15)", 1), device("GeForce RTX", 4),
                                       device("Intel UHD", 3)};

std::string refusal(const std::vector<DeviceReport>& reports, const std::string& request) {
  try {
    choose_device(reports, request);
  } catch (const NoDevice& error) {
    return error.what();
  }
  return "chosen";
}

TEST(ChooseDevice, PrefersTheHighestRankThatIsUsable) {
  EXPECT_EQ(choose_device(kThree, ""), 1U);
  EXPECT_EQ(choose_device({device("old", 4, {"a compute queue"}), device("cpu", 1)}, ""), 1U);
}

TEST(ChooseDevice, TakesANumberOrAPartOfAName) {
  EXPECT_EQ(choose_device(kThree, "0"), 0U);
  EXPECT_EQ(choose_device(kThree, "LLVMpipe"), 0U);
  EXPECT_EQ(choose_device(kThree, "uhd"), 2U);
}

TEST(ChooseDevice, RefusalsListEveryDeviceAndWhatItLacks) {
  EXPECT_EQ(refusal(kThree, "radeon"),
            "no Vulkan device is called 'radeon'; there is 0 llvmpipe (LLVM 15); 1 GeForce RTX; 2 "
            "Intel UHD.");
  EXPECT_EQ(
      refusal(kThree, "7"),
      "no Vulkan device is called '7'; there is 0 llvmpipe (LLVM 15); 1 GeForce RTX; 2 Intel UHD.");
  EXPECT_EQ(refusal(kThree, "l"),
            "'l' fits several Vulkan devices, name one by its number: 0 llvmpipe (LLVM 15); 1 "
            "GeForce RTX; "
            "2 Intel UHD.");
  const std::vector<DeviceReport> poor{device("A", 4, {"Vulkan 1.1.0", "a compute queue"}),
                                       device("B", 1, {"a compute queue"})};
  EXPECT_EQ(refusal(poor, ""),
            "no Vulkan device can be used: 0 A lacks Vulkan 1.1.0, a compute queue; 1 B lacks a "
            "compute queue.");
  EXPECT_EQ(refusal(poor, "1"),
            "the Vulkan device asked for cannot be used: 0 A lacks Vulkan 1.1.0, a compute queue; "
            "1 B lacks a "
            "compute queue.");
  EXPECT_EQ(refusal({}, "").find("no Vulkan device was found"), 0U);
}

}  // namespace
}  // namespace trisect::gpu
