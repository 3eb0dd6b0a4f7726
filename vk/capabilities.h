// What a physical device can do, asked once: for the list of devices and for gpu::Device.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trisect::gpu {

// What kernels take of a device's limits: a device that has less cannot be used. Each number is the
// most that one of the program's kernels takes; a test compares them with the kernels.
struct KernelNeeds {
  static constexpr uint32_t kInvocations = 64;  // of a workgroup, along x too
  static constexpr uint32_t kInvocationsY = 8;
  static constexpr uint32_t kSharedBytes = 1024;   // of a workgroup
  static constexpr uint32_t kStorageBuffers = 12;  // of a stage, which are those of its one set
  static constexpr uint32_t kUniformBuffers = 2;
  static constexpr uint32_t kPushBytes = 36;
  // The buffers of tile lists count on as many bytes in one binding.
  static constexpr uint32_t kStorageRange = 128U << 20U;
};

// What a device's limits lack of that, each a part of a sentence that names the limit: "12 storage
// buffers in a stage (maxPerStageDescriptorStorageBuffers is 4)".
std::vector<std::string> unmet_needs(const VkPhysicalDeviceLimits& limits);

// What a module may declare of 32-bit floats (SPV_KHR_float_controls); without a declaration it is
// the driver's choice.
struct FloatControls {
  bool rounds_to_nearest_even = false;         // RoundingModeRTE
  bool preserves_signed_zero_inf_nan = false;  // SignedZeroInfNanPreserve
  bool preserves_denormals = false;            // DenormPreserve

  bool operator==(const FloatControls&) const = default;
};

// The subgroups of compute kernels.
struct SubgroupSupport {
  // Invocations per subgroup as the device reports it; 0 if kernels lack the vote, ballot or
  // arithmetic operations. Where a kernel asks for no size, the driver may run fewer.
  uint32_t size = 0;
  // A kernel of KernelNeeds::kInvocations may ask for the powers of two from least to most; both
  // are 0 if it may not (VK_EXT_subgroup_size_control).
  uint32_t least = 0;
  uint32_t most = 0;
  bool full = false;  // a kernel may ask for subgroups in which all invocations are there
  // A kernel may ask that invocations of a subgroup that enter a loop or a branch together are
  // together again after it (VK_KHR_shader_subgroup_uniform_control_flow).
  bool reconverge = false;

  // Those that a kernel may ask for, in ascending order.
  [[nodiscard]] std::vector<uint32_t> sizes() const;
};

// The subgroups that kernels are made for.
struct SubgroupChoice {
  uint32_t size = 0;      // invocations; 0 if the operations are lacking
  bool required = false;  // a kernel asks for this size, else it is what the device reports
  bool full = false;      // a kernel asks for full subgroups

  // Invocations that each subgroup of a kernel has for certain; 0 if that is not known. What a
  // driver reports and is not asked for is no promise: Intel's has run fewer.
  [[nodiscard]] uint32_t certain_size() const { return required && full ? size : 0; }

  bool operator==(const SubgroupChoice&) const = default;
};

// The subgroups for a device. asked: one of support.sizes(), or 0: as if the operations were
// lacking; empty: the best. Nothing if the device cannot run the size asked for.
std::optional<SubgroupChoice> choose_subgroups(const SubgroupSupport& support,
                                               std::optional<uint32_t> asked);

struct Capabilities {
  VkPhysicalDevice device = VK_NULL_HANDLE;
  VkPhysicalDeviceProperties properties{};
  // The Vulkan version that can be used: the device's, or the instance's if that is less.
  uint32_t version = 0;
  std::string driver;  // name and version
  // The first queue family with compute, if there is one.
  std::optional<uint32_t> compute_family;
  std::vector<std::string> extensions;
  // What follows is false or 0 for a device of Vulkan 1.0, which cannot be used.
  SubgroupSupport subgroups;
  FloatControls floats;
  // SwiftShader compiles the code that specialisation constants rule out, too, and gives each local
  // variable its own place on the stack. Beyond the stack's limit vkCreateComputePipelines crashes;
  // below it, a kernel takes half the time if specialized() has seen it. lavapipe gains nothing.
  bool wants_specialized_code = false;
  bool buffer_addresses = false;
  // llvmpipe of recent Mesa loads from an address with one instruction for all lanes of a subgroup,
  // and from a binding lane by lane, with a comparison for its bounds.
  bool loads_fast_by_address = false;
  bool fault_reports = false;  // of a lost device (VK_EXT_device_fault)
  bool ray_queries = false;
  VkDeviceSize scratch_alignment = 1;  // of builds of acceleration structures; if ray_queries

  // Whether the device lists the extension.
  [[nodiscard]] bool lists(std::string_view extension) const;
  // Whether what the extension brings can be asked for and used: it is in the Vulkan version since
  // `core`, or the extension is listed.
  [[nodiscard]] bool offers(const char* extension, uint32_t core) const {
    return version >= core || lists(extension);
  }
};

// For offers(): no Vulkan version has it.
inline constexpr uint32_t kNeverCore = UINT32_MAX;

// instance_version: what the instance was made for. Throws Error if the driver fails.
Capabilities capabilities_of(VkPhysicalDevice device, uint32_t instance_version);

// The extensions that a device must enable for what its capabilities say: those that its version
// does not have anyway.
std::vector<const char*> extensions_for(const Capabilities& capabilities);

}  // namespace trisect::gpu
