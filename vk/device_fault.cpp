#include "vk/device_fault.h"

#include <cstdint>
#include <cstdio>
#include <vector>

namespace trisect::gpu {
namespace {

std::string hexadecimal(uint64_t value) {
  char text[19];
  std::snprintf(text, sizeof(text), "0x%llx", static_cast<unsigned long long>(value));
  return text;
}

const char* kind_of(VkDeviceFaultAddressTypeEXT type) {
  switch (type) {
    case VK_DEVICE_FAULT_ADDRESS_TYPE_READ_INVALID_EXT:
      return "invalid read";
    case VK_DEVICE_FAULT_ADDRESS_TYPE_WRITE_INVALID_EXT:
      return "invalid write";
    case VK_DEVICE_FAULT_ADDRESS_TYPE_EXECUTE_INVALID_EXT:
      return "invalid execution";
    case VK_DEVICE_FAULT_ADDRESS_TYPE_INSTRUCTION_POINTER_UNKNOWN_EXT:
    case VK_DEVICE_FAULT_ADDRESS_TYPE_INSTRUCTION_POINTER_INVALID_EXT:
    case VK_DEVICE_FAULT_ADDRESS_TYPE_INSTRUCTION_POINTER_FAULT_EXT:
      return "instruction pointer";
    default:
      return "address";
  }
}

// The address is known up to a power of two.
std::string text_of(const VkDeviceFaultAddressInfoEXT& info) {
  const uint64_t below = info.addressPrecision - 1;
  return std::string(kind_of(info.addressType)) + " at " +
         hexadecimal(info.reportedAddress & ~below) + " to " +
         hexadecimal(info.reportedAddress | below);
}

std::string text_of(const VkDeviceFaultVendorInfoEXT& info) {
  return std::string(info.description) + " (code " + hexadecimal(info.vendorFaultCode) + ", data " +
         hexadecimal(info.vendorFaultData) + ")";
}

}  // namespace

std::string fault_report(VkDevice device, PFN_vkGetDeviceFaultInfoEXT get) {
  VkDeviceFaultCountsEXT counts{VK_STRUCTURE_TYPE_DEVICE_FAULT_COUNTS_EXT};
  if (get(device, &counts, nullptr) != VK_SUCCESS) return "";
  counts.vendorBinarySize = 0;
  std::vector<VkDeviceFaultAddressInfoEXT> addresses(counts.addressInfoCount);
  std::vector<VkDeviceFaultVendorInfoEXT> vendors(counts.vendorInfoCount);
  VkDeviceFaultInfoEXT info{VK_STRUCTURE_TYPE_DEVICE_FAULT_INFO_EXT};
  info.pAddressInfos = addresses.data();
  info.pVendorInfos = vendors.data();
  const VkResult result = get(device, &counts, &info);
  if (result != VK_SUCCESS && result != VK_INCOMPLETE) return "";
  std::string text = info.description;
  const auto add = [&text](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  for (uint32_t i = 0; i < counts.addressInfoCount; ++i) add(text_of(addresses[i]));
  for (uint32_t i = 0; i < counts.vendorInfoCount; ++i) add(text_of(vendors[i]));
  for (char& c : text) c = c == '\n' ? ' ' : c;
  return text;
}

}  // namespace trisect::gpu
