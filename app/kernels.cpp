#include "app/kernels.h"

#include <array>

namespace trisect {
namespace {

// Written at build time: arrays of SPIR-V words.
#include "trace_list.spv.h"

}  // namespace

const std::span<const uint32_t> kTraceListSpirv(trace_list_spirv);

gpu::KernelInterface trace_list_interface() {
  return {{{BINDING_PARAMS, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
           {BINDING_TRIANGLES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_COLOR, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_AOVS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}},
          sizeof(TilePush)};
}

}  // namespace trisect
