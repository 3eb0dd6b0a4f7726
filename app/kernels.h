// The compiled kernels, and the interfaces that shaders/shared.h gives them.
#pragma once

#include <cstdint>
#include <span>

#include "app/shared.h"
#include "vk/kernel.h"

namespace trisect {

extern const std::span<const uint32_t> kTraceListSpirv;

gpu::KernelInterface trace_list_interface();

}  // namespace trisect
