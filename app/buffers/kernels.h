// The compiled kernels, and the interfaces that shaders/shared.h gives them.
#pragma once

#include <cstdint>
#include <span>

#include "app/buffers/kernel_code.h"
#include "app/surface/shared.h"
#include "vk/kernel.h"

namespace trisect {

extern const std::span<const uint32_t> kTraceListSpirv;
extern const std::span<const uint32_t> kProjectSubpatchesSpirv;
extern const std::span<const uint32_t> kBinSubpatchesSpirv;
extern const std::span<const uint32_t> kFillSkySpirv;
extern const std::span<const uint32_t> kTraceTilesSpirv;
extern const std::span<const uint32_t> kTraceUndecidedSpirv;
extern const std::span<const uint32_t> kTracePacketsSpirv;
extern const std::span<const uint32_t> kTraceBvhSpirv;
// Those of --accel bvh, for scenes whose buffers are too large to be bound.
extern const std::span<const uint32_t> kTracePacketsAtSpirv;
extern const std::span<const uint32_t> kTraceBvhAtSpirv;
extern const std::span<const uint32_t> kTraceQuerySpirv;
extern const std::span<const uint32_t> kClearImageSpirv;
// Of the window that shows a frame.
extern const std::span<const uint32_t> kScreenVertSpirv;
extern const std::span<const uint32_t> kScreenFragSpirv;
extern const std::span<const uint32_t> kCastRaysSpirv;
extern const std::span<const uint32_t> kCastByBvhSpirv;

// The kernel of that name in `code`; built_in if there is none, or if code is null.
std::span<const uint32_t> newest(const KernelCode* code, const char* name,
                                 std::span<const uint32_t> built_in);

// GLSL for OpenGL, without a version; frame_buffers.glsl says what else goes ahead of it.
extern const char* const kTraceListComp;
extern const char* const kTraceListFrag;
extern const char* const kFullScreenVert;
extern const char* const kTessellatedVert;
extern const char* const kTessellatedTesc;
extern const char* const kTessellatedTese;
extern const char* const kTessellatedFrag;
extern const char* const kSkyFrag;

// Of the kernels that make a frame: they share a descriptor set.
gpu::KernelInterface frame_interface();
gpu::KernelInterface cast_rays_interface();
// Of the fragment shader that shows a frame in a window.
gpu::KernelInterface screen_interface();
// Of the kernel that writes an image and nothing else.
gpu::KernelInterface clear_image_interface();

}  // namespace trisect
