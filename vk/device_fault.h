// What a driver says of the loss of its device: VK_EXT_device_fault.
#pragma once

#include <vulkan/vulkan.h>

#include <string>

namespace trisect::gpu {

// The report on a device that is lost: the driver's description, the addresses and the vendor's
// codes, in one line. Empty if the driver has nothing to say. get: vkGetDeviceFaultInfoEXT.
std::string fault_report(VkDevice device, PFN_vkGetDeviceFaultInfoEXT get);

}  // namespace trisect::gpu
