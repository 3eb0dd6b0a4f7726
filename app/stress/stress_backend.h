// The back ends that the hard cases can run on.
#pragma once

#include "app/stress/stress_cases.h"
#include "vk/device.h"

namespace trisect {

// By Vulkan. Compiles each kernel once, when a case first needs it. The device must outlive the
// returned back end and its copies.
StressBackend vulkan_stress_backend(const gpu::Device& device);
// By the kernel compiled as C++ in single precision, on all cores.
StressBackend cpu_stress_backend();

}  // namespace trisect
