#include "app/buffers/kernels.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "app/buffers/float_operations.h"

namespace trisect {
namespace {

// Text for OpenGL: a line trisect_glsl() of shaders/CMakeLists.txt.
struct GlslText {
  const char* file;
  const char* text;
};

// kKernels and kGlslTexts.
#include "kernel_list.h"

const KernelSource& find_kernel(std::string_view name) {
  const auto* const found = std::find_if(std::begin(kKernels), std::end(kKernels),
                                         [name](const KernelSource& k) { return k.name == name; });
  if (found == std::end(kKernels)) {
    throw std::logic_error("shaders/CMakeLists.txt lists no kernel " + std::string(name));
  }
  return *found;
}

gpu::KernelInterface cast_interface() {
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

gpu::KernelInterface clear_interface() {
  return {{{BINDING_PARAMS, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
           {BINDING_COLOR, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}},
          0};
}

gpu::KernelInterface floats_interface() {
  return {{{FLOATS_INPUTS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {FLOATS_FLOAT_INPUTS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {FLOATS_RESULTS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {FLOATS_COPIES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}},
          sizeof(FloatsPush)};
}
}  // namespace

std::span<const KernelSource> kernel_sources() {
  return kKernels;
}

std::span<const uint32_t> spirv_of(std::string_view name, const KernelCode* code) {
  const KernelSource& built_in = find_kernel(name);
  if (code == nullptr) return built_in.spirv;
  const auto found = code->find(name);
  return found == code->end() ? built_in.spirv : found->second;
}

const char* glsl_of(std::string_view file) {
  const auto* const found = std::find_if(std::begin(kGlslTexts), std::end(kGlslTexts),
                                         [file](const GlslText& t) { return t.file == file; });
  if (found == std::end(kGlslTexts)) {
    throw std::logic_error("shaders/CMakeLists.txt lists no GLSL " + std::string(file));
  }
  return found->text;
}

gpu::KernelInterface interface_of(std::string_view name) {
  switch (find_kernel(name).interface) {
    case Interface::cast:
      return cast_interface();
    case Interface::clear:
      return clear_interface();
    case Interface::floats:
      return floats_interface();
    case Interface::screen:
      return screen_interface();
    default:
      return frame_interface();
  }
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
           {BINDING_TILE_LISTS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_TILE_SUBPATCHES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_TILE_ORDER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_TILE_TOTALS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_BVH, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
           {BINDING_ADDRESSES, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER}},
          sizeof(TilePush)};
}

gpu::Kernel make_kernel(const gpu::Device& device, const char* name,
                        const std::vector<gpu::Specialization>& constants, const KernelCode* code) {
  return {device, spirv_of(name, code), interface_of(name), constants, name};
}

}  // namespace trisect
