// The back ends as the hard cases use them.
#pragma once

#include "app/stress/stress_cases.h"
#include "vk/device.h"

namespace trisect {

// Compiles each kernel once. The device must outlive what is returned.
StressBackend vulkan_stress_backend(const gpu::Device& device);
StressBackend cpu_stress_backend();

}  // namespace trisect
