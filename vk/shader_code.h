// What is done to the SPIR-V of a shader between glslang and the driver. Vulkan lets a driver
// contract a * b + c, flush denormals and drop NaNs wherever the module does not say otherwise; the
// kernels' arithmetic is proven for the operations as they are written.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vk/capabilities.h"

namespace trisect::gpu {

// The value of a specialisation constant; a bool is 0 or 1.
struct Specialization {
  uint32_t constant_id;
  uint32_t value;

  bool operator==(const Specialization&) const = default;
};

using ShaderCode = std::vector<uint32_t>;

// All functions take the words of a valid module, throw std::logic_error if it is cut off, and are
// safe to call from any thread.

// What a pipeline must know of a kernel's module.
struct KernelFacts {
  bool uses_subgroups = false;  // their operations
  uint32_t workgroup_x = 0;     // invocations of a workgroup along x
};
KernelFacts facts_of(std::span<const uint32_t> spirv);

// With NoContraction on every operation of floats that rounds. GLSL's `precise` does not reach what
// a called function computes.
ShaderCode with_exact_floats(std::span<const uint32_t> spirv);

// With the execution modes RoundingModeRTE, SignedZeroInfNanPreserve and DenormPreserve for 32 bits
// (SPV_KHR_float_controls), those that the device has.
ShaderCode with_float_controls(std::span<const uint32_t> spirv, const FloatControls& controls);

// With the execution mode SubgroupUniformControlFlowKHR (SPV_KHR_subgroup_uniform_control_flow):
// see SubgroupSupport::reconverge.
ShaderCode with_reconverging_subgroups(std::span<const uint32_t> spirv);

// With these values, or else their defaults, in place of the specialisation constants, and with
// only the code that they leave, in one function. Operations that have NoContraction keep it, and
// are not folded. Throws std::runtime_error if SPIRV-Tools cannot do it.
ShaderCode specialized(std::span<const uint32_t> spirv,
                       const std::vector<Specialization>& constants);

}  // namespace trisect::gpu
