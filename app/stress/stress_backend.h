// The back ends as the hard cases use them.
#pragma once

#include "app/stress/stress_cases.h"
#include "vk/device.h"

namespace trisect {

// Compiles each kernel once. The device must outlive what is returned.
HardBackend vulkan_hard_backend(const gpu::Device& device);
HardBackend cpu_hard_backend();

}  // namespace trisect
