#include "app/buffers/kernels.h"

#include <array>

namespace trisect {
namespace {

// Written at build time: arrays of SPIR-V words.
#include "bin_subpatches.spv.h"
#include "cast_by_bvh.spv.h"
#include "cast_rays.spv.h"
#include "clear_image.spv.h"
#include "fill_sky.spv.h"
#include "project_subpatches.spv.h"
#include "screen_frag.spv.h"
#include "screen_vert.spv.h"
#include "trace_bvh.spv.h"
#include "trace_bvh_at.spv.h"
#include "trace_list.spv.h"
#include "trace_packets.spv.h"
#include "trace_packets_at.spv.h"
#include "trace_query.spv.h"
#include "trace_tiles.spv.h"
#include "trace_undecided.spv.h"
// Strings of GLSL.
#include "full_screen.vert.glsl.h"
#include "sky.frag.glsl.h"
#include "tessellated.frag.glsl.h"
#include "tessellated.tesc.glsl.h"
#include "tessellated.tese.glsl.h"
#include "tessellated.vert.glsl.h"
#include "trace_list.comp.glsl.h"
#include "trace_list.frag.glsl.h"

}  // namespace

const std::span<const uint32_t> kTraceListSpirv(trace_list_spirv);
const std::span<const uint32_t> kProjectSubpatchesSpirv(project_subpatches_spirv);
const std::span<const uint32_t> kBinSubpatchesSpirv(bin_subpatches_spirv);
const std::span<const uint32_t> kFillSkySpirv(fill_sky_spirv);
const std::span<const uint32_t> kTraceTilesSpirv(trace_tiles_spirv);
const std::span<const uint32_t> kTraceUndecidedSpirv(trace_undecided_spirv);
const std::span<const uint32_t> kTracePacketsSpirv(trace_packets_spirv);
const std::span<const uint32_t> kTracePacketsAtSpirv(trace_packets_at_spirv);
const std::span<const uint32_t> kTraceBvhSpirv(trace_bvh_spirv);
const std::span<const uint32_t> kTraceBvhAtSpirv(trace_bvh_at_spirv);
const std::span<const uint32_t> kTraceQuerySpirv(trace_query_spirv);
const std::span<const uint32_t> kClearImageSpirv(clear_image_spirv);
const std::span<const uint32_t> kScreenVertSpirv(screen_vert_spirv);
const std::span<const uint32_t> kScreenFragSpirv(screen_frag_spirv);
const std::span<const uint32_t> kCastRaysSpirv(cast_rays_spirv);
const std::span<const uint32_t> kCastByBvhSpirv(cast_by_bvh_spirv);

const char* const kTraceListComp = trace_list_comp_glsl;
const char* const kTraceListFrag = trace_list_frag_glsl;
const char* const kFullScreenVert = full_screen_vert_glsl;
const char* const kTessellatedVert = tessellated_vert_glsl;
const char* const kTessellatedTesc = tessellated_tesc_glsl;
const char* const kTessellatedTese = tessellated_tese_glsl;
const char* const kTessellatedFrag = tessellated_frag_glsl;
const char* const kSkyFrag = sky_frag_glsl;

std::span<const uint32_t> newest(const KernelCode* code, const char* name,
                                 std::span<const uint32_t> built_in) {
  if (code == nullptr) return built_in;
  const auto found = code->find(name);
  return found == code->end() ? built_in : found->second;
}

gpu::KernelInterface screen_interface() {
  return {{{BINDING_COLOR, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_AOVS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}},
          sizeof(ScreenPush)};
}

gpu::KernelInterface frame_interface() {
  return {{{BINDING_PARAMS, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
           {BINDING_TRIANGLES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_COLOR, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_AOVS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_SUBPATCHES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_QUEUE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_QUEUED, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_PROJECTED, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_TILE_COUNTS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_TILE_SUBPATCHES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_TILE_ORDER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_TILES_SEEN, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_BVH, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_ADDRESSES, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER}},
          sizeof(TilePush)};
}

gpu::KernelInterface clear_image_interface() {
  return {{{BINDING_PARAMS, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
           {BINDING_COLOR, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}},
          0};
}

gpu::KernelInterface cast_rays_interface() {
  return {{{BINDING_PARAMS, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
           {BINDING_TRIANGLES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_SUBPATCHES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_RAYS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_HITS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_QUEUE, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_QUEUED, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_BVH, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}},
          sizeof(CastPush)};
}

}  // namespace trisect
