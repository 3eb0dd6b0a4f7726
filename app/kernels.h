// The compiled kernels, and the interfaces that shaders/shared.h gives them.
#pragma once

#include <cstdint>
#include <span>

#include "app/shared.h"
#include "vk/kernel.h"

namespace trisect {

extern const std::span<const uint32_t> kTraceListSpirv;
extern const std::span<const uint32_t> kCastRaysSpirv;

// GLSL for OpenGL, without a version; frame_buffers.glsl says what else goes ahead of it.
extern const char* const kTraceListComp;
extern const char* const kTraceListFrag;
extern const char* const kFullScreenVert;

gpu::KernelInterface trace_list_interface();
gpu::KernelInterface cast_rays_interface();

}  // namespace trisect
