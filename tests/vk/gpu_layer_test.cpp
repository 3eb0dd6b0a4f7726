// The Vulkan layer on the device of this machine.
#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>
#include <vector>

#include "app/buffers/kernels.h"
#include "tests/support/gpu.h"
#include "vk/commands.h"
#include "vk/result.h"

namespace trisect::gpu {
namespace {

class GpuLayer : public test::GpuTest {};

TEST_F(GpuLayer, ValidationSpeaksUpWhenACallIsWrong) {
  // The other GPU tests rely on the validation layer to report mistakes. This one makes a mistake:
  // a buffer of 0 bytes.
  const Device& device = test::validated_device();
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  vkCreateBuffer(device.get(), &info, nullptr, &buffer);
  if (buffer != VK_NULL_HANDLE) vkDestroyBuffer(device.get(), buffer, nullptr);
  const std::vector<std::string> messages = test::validated_instance().log().messages();
  test::validated_instance().log().clear();
  ASSERT_FALSE(messages.empty());
  EXPECT_NE(messages[0].find("VUID-VkBufferCreateInfo-size-00912"), std::string::npos)
      << messages[0];
}

TEST_F(GpuLayer, SynchronisationValidationMissesNoBarrier) {
  // Likewise for missing barriers: two copies to the same bytes without one between them.
  const Device& device = test::validated_device();
  const Buffer a(device, 64, Memory::device, "a");
  const Buffer b(device, 64, Memory::device, "b");
  Owned<VkCommandPool, vkDestroyCommandPool> pool;
  VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool_info.queueFamilyIndex = device.family();
  TRISECT_VK(vkCreateCommandPool(device.get(), &pool_info, nullptr, pool.fill(device.get())));
  VkCommandBufferAllocateInfo allocation{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  allocation.commandPool = pool.get();
  allocation.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  TRISECT_VK(vkAllocateCommandBuffers(device.get(), &allocation, &commands));
  const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  TRISECT_VK(vkBeginCommandBuffer(commands, &begin));
  const VkBufferCopy region{0, 0, 64};
  vkCmdCopyBuffer(commands, a.get(), b.get(), 1, &region);
  vkCmdCopyBuffer(commands, a.get(), b.get(), 1, &region);
  TRISECT_VK(vkEndCommandBuffer(commands));
  const std::vector<std::string> messages = test::validated_instance().log().messages();
  test::validated_instance().log().clear();
  ASSERT_FALSE(messages.empty());
  EXPECT_NE(messages[0].find("SYNC-HAZARD-WRITE-AFTER-WRITE"), std::string::npos) << messages[0];
}

TEST_F(GpuLayer, BytesComeBackFromTheDevice) {
  const Device& device = test::validated_device();
  Commands commands(device);
  std::vector<uint32_t> sent(10007);
  std::iota(sent.begin(), sent.end(), 1U);
  const Buffer buffer(device, sent.size() * sizeof(uint32_t), Memory::device, "numbers");
  // In one piece, and in pieces whose size does not divide that of the buffer.
  for (const std::size_t piece : {std::size_t{1} << 20U, std::size_t{4096}}) {
    Staging staging(device, piece);
    staging.upload(commands, std::as_bytes(std::span(sent)), buffer);
    std::vector<uint32_t> received(sent.size());
    staging.download(commands, buffer, std::as_writable_bytes(std::span(received)));
    EXPECT_EQ(received, sent);
  }
}

TEST_F(GpuLayer, OrdersWhatOneSubmitDoes) {
  // A chain of copies, each of which reads what the one before wrote, and one that writes what was
  // read. Without the barriers of Commands, synchronisation validation finds a hazard at every
  // link.
  const Device& device = test::validated_device();
  Commands commands(device);
  const Buffer in(device, 64, Memory::host, "in");
  const Buffer a(device, 64, Memory::device, "a");
  const Buffer b(device, 64, Memory::device, "b");
  const Buffer out(device, 64, Memory::host, "out");
  for (std::size_t i = 0; i < 64; ++i) in.bytes()[i] = static_cast<std::byte>(i);
  commands.begin();
  commands.copy(in, 0, a, 0, 64);
  commands.copy(a, 0, b, 32, 32);
  commands.copy(a, 32, b, 0, 32);
  commands.copy(b, 0, a, 0, 64);
  commands.copy(a, 0, out, 0, 64);
  commands.submit_and_wait();
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_EQ(out.bytes()[i], static_cast<std::byte>((i + 32) % 64));
  }
}

TEST_F(GpuLayer, ChecksWhatADispatchIsGiven) {
  const Device& device = test::validated_device();
  const Kernel kernel(device, spirv_of("trace_list"), frame_interface(), {}, "trace_list");
  const Buffer buffer(device, 1024, Memory::device, "scratch");
  EXPECT_THROW(DescriptorSet(device, kernel, {&buffer}), std::logic_error);
  const DescriptorSet bound(device, kernel,
                            std::vector<const Buffer*>(frame_interface().bindings.size(), &buffer));
  Commands commands(device);
  commands.begin();
  EXPECT_THROW(commands.dispatch(kernel, bound, {}, 1), std::logic_error);
  commands.submit_and_wait();
}

TEST_F(GpuLayer, SaysWhatCouldNotBeAllocated) {
  try {
    const Buffer buffer(test::validated_device(), std::size_t{1} << 50U, Memory::device, "huge");
    FAIL() << "a petabyte was allocated";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("huge"), std::string::npos) << error.what();
  }
  // The validation layer warns of such a request: these messages are not a failure of this test.
  test::validated_instance().log().clear();
}

TEST_F(GpuLayer, ReportsTheDevicesOfTheInstance) {
  const std::vector<DeviceReport> reports = test::validated_instance().reports();
  ASSERT_FALSE(reports.empty());
  for (const DeviceReport& report : reports) {
    EXPECT_FALSE(report.name.empty());
    EXPECT_FALSE(report.type.empty());
    EXPECT_FALSE(report.driver.empty());
  }
  EXPECT_GT(test::validated_device().limits().maxStorageBufferRange, 0U);
}

TEST(Result, IsNamedInTheErrorWithItsCall) {
  try {
    check(VK_ERROR_DEVICE_LOST, "vkQueueSubmit(queue, 1, &submit, fence)");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("vkQueueSubmit (VK_ERROR_DEVICE_LOST)"),
              std::string::npos)
        << error.what();
  }
}

TEST(Result, TellsTheKindOfTheError) {
  EXPECT_NO_THROW(check(VK_SUCCESS, "vkX()"));
  EXPECT_THROW(check(VK_ERROR_DEVICE_LOST, "vkX()"), DeviceLost);
  for (const VkResult result : {VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY,
                                VK_ERROR_OUT_OF_POOL_MEMORY, VK_ERROR_MEMORY_MAP_FAILED}) {
    EXPECT_THROW(check(result, "vkX()"), OutOfMemory) << result_name(result);
  }
  for (const VkResult result : {VK_ERROR_INITIALIZATION_FAILED, VK_ERROR_SURFACE_LOST_KHR}) {
    try {
      check(result, "vkX()");
      ADD_FAILURE() << result_name(result);
    } catch (const DeviceLost&) {
      ADD_FAILURE() << result_name(result);
    } catch (const OutOfMemory&) {
      ADD_FAILURE() << result_name(result);
    } catch (const Error&) {
    }
  }
}

TEST(Result, IsSpelledAsTheSpecificationDoes) {
  EXPECT_EQ(result_name(VK_SUCCESS), "VK_SUCCESS");
  EXPECT_EQ(result_name(VK_ERROR_OUT_OF_DATE_KHR), "VK_ERROR_OUT_OF_DATE_KHR");
  EXPECT_EQ(result_name(VK_SUBOPTIMAL_KHR), "VK_SUBOPTIMAL_KHR");
}

}  // namespace
}  // namespace trisect::gpu
