// The shaders that shaders/CMakeLists.txt lists, by name: their SPIR-V or GLSL, and what they bind.
//
// All functions are safe to call from any thread: they read constant tables. A name that is not in
// the list is a mistake of the caller: std::logic_error.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "app/buffers/kernel_code.h"
#include "app/surface/shared.h"
#include "vk/kernel.h"

namespace trisect {

// What a shader finds in descriptor set 0, and its push constants. Kernels of the same interface
// can share a descriptor set.
enum class Interface {
  frame,   // kernels that make a frame: TilePush
  cast,    // kernels that cast rays from a buffer: CastPush
  clear,   // the kernel that clears an image: no push constants
  floats,  // kernels that try a device's arithmetic: FloatsPush
  screen,  // the shaders that show a frame in a window: ScreenPush
};

// A line trisect_kernel() of shaders/CMakeLists.txt.
struct KernelSource {
  const char* name;
  const char* file;      // in the folder shaders/
  const char* preamble;  // text ahead of the file's, such as "#define TRISECT_ADDRESSES\n"; or ""
  bool ray_queries;      // uses GL_EXT_ray_query, which needs SPIR-V 1.4
  Interface interface;
  std::span<const uint32_t> spirv;  // compiled by the build
};

// All of them, in the order of the list.
std::span<const KernelSource> kernel_sources();

// The SPIR-V words of a kernel: those in `code` if it has the kernel, else those of the build.
// code: compiled anew while the program runs, or null; it must outlive the words.
std::span<const uint32_t> spirv_of(std::string_view name, const KernelCode* code = nullptr);

// The text of a shader for OpenGL by its file name, such as "trace_list.comp", without #version;
// app/opengl/shader_head.h says what goes ahead of it.
const char* glsl_of(std::string_view file);

gpu::KernelInterface interface_of(std::string_view name);
gpu::KernelInterface frame_interface();
gpu::KernelInterface screen_interface();

// The compute pipeline of a kernel with these specialisation constants. code: as spirv_of takes it.
// Throws DeviceError if the device cannot make it.
gpu::Kernel make_kernel(const gpu::Device& device, const char* name,
                        const std::vector<gpu::Specialization>& constants,
                        const KernelCode* code = nullptr);

}  // namespace trisect
