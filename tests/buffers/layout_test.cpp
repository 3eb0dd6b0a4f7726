// The compiled kernels, read with SPIRV-Cross: the members of their buffers have the offsets that
// C++ gives them, and their bindings are those of the interfaces in app/buffers/kernels.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <spirv_cross/spirv_cross.hpp>
#include <string>
#include <utility>

#include "app/buffers/kernels.h"

namespace trisect {
namespace {

using spirv_cross::Compiler;
using Offsets = std::map<std::string, std::size_t>;

Compiler reflect(std::span<const uint32_t> spirv = spirv_of("trace_list")) {
  return Compiler(std::vector<uint32_t>(spirv.begin(), spirv.end()));
}

Offsets offsets_of(const Compiler& compiler, const spirv_cross::SPIRType& type) {
  Offsets offsets;
  for (uint32_t i = 0; i < type.member_types.size(); ++i) {
    offsets[compiler.get_member_name(type.self, i)] = compiler.type_struct_member_offset(type, i);
  }
  return offsets;
}

// The structure that is a block's only member (of an array: its elements): the offsets of its
// members, and its size with the padding between elements.
struct Held {
  Offsets offsets;
  std::size_t stride;
};
Held held_by(const Compiler& compiler, const spirv_cross::Resource& block) {
  const spirv_cross::SPIRType& outer = compiler.get_type(block.base_type_id);
  const spirv_cross::SPIRType& inner = compiler.get_type(outer.member_types[0]);
  const std::size_t stride = inner.array.empty()
                                 ? compiler.get_declared_struct_size(inner)
                                 : compiler.type_struct_member_array_stride(outer, 0);
  // The elements of an array of vec4 are no structures.
  return {inner.basetype == spirv_cross::SPIRType::Struct ? offsets_of(compiler, inner) : Offsets{},
          stride};
}

const spirv_cross::Resource& with_binding(
    const Compiler& compiler, const spirv_cross::SmallVector<spirv_cross::Resource>& resources,
    uint32_t binding) {
  for (const spirv_cross::Resource& resource : resources) {
    if (compiler.get_decoration(resource.id, spv::DecorationBinding) == binding) return resource;
  }
  throw std::runtime_error("no resource with binding " + std::to_string(binding));
}

// The structure in the buffer that a kernel has at this binding.
Held bound_to(uint32_t binding, std::span<const uint32_t> spirv = spirv_of("trace_list")) {
  const Compiler compiler = reflect(spirv);
  const auto resources = compiler.get_shader_resources();
  const auto& buffers = binding == BINDING_PARAMS || binding == BINDING_ADDRESSES
                            ? resources.uniform_buffers
                            : resources.storage_buffers;
  return held_by(compiler, with_binding(compiler, buffers, binding));
}

TEST(Layout, TriangleIsTheThesissIn192Bytes) {
  const Held held = bound_to(BINDING_TRIANGLES);
  EXPECT_EQ(held.stride, sizeof(Triangle));
  EXPECT_EQ(held.offsets, (Offsets{{"Position", offsetof(Triangle, Position)},
                                   {"Normal", offsetof(Triangle, Normal)},
                                   {"TriNormal", offsetof(Triangle, TriNormal)},
                                   {"NormDot", offsetof(Triangle, NormDot)},
                                   {"Domain", offsetof(Triangle, Domain)},
                                   {"VertexData", offsetof(Triangle, VertexData)}}));
}

TEST(Layout, SubpatchBounds) {
  const Held held = bound_to(BINDING_SUBPATCHES);
  EXPECT_EQ(held.stride, sizeof(SubpatchBounds));
  EXPECT_EQ(held.offsets,
            (Offsets{{"ball", offsetof(SubpatchBounds, ball)},
                     {"sub_triangle", offsetof(SubpatchBounds, sub_triangle)},
                     {"corner", offsetof(SubpatchBounds, corner)},
                     {"edge", offsetof(SubpatchBounds, edge)},
                     {"triangle", offsetof(SubpatchBounds, triangle)},
                     {"cone", offsetof(SubpatchBounds, cone)},
                     {"is_flat", offsetof(SubpatchBounds, is_flat)},
                     {"gradient_lipschitz", offsetof(SubpatchBounds, gradient_lipschitz)},
                     {"skip", offsetof(SubpatchBounds, skip)}}));
}

TEST(Layout, ProjectedSubpatch) {
  const Held held = bound_to(BINDING_PROJECTED, spirv_of("project_subpatches"));
  EXPECT_EQ(held.stride, sizeof(ProjectedSubpatch));
  EXPECT_EQ(held.offsets, (Offsets{{"box", offsetof(ProjectedSubpatch, box)},
                                   {"lines_x", offsetof(ProjectedSubpatch, lines_x)},
                                   {"lines_y", offsetof(ProjectedSubpatch, lines_y)},
                                   {"triangle", offsetof(ProjectedSubpatch, triangle)},
                                   {"lines_at", offsetof(ProjectedSubpatch, lines_at)},
                                   {"P0", offsetof(ProjectedSubpatch, P0)},
                                   {"P1", offsetof(ProjectedSubpatch, P1)},
                                   {"P2", offsetof(ProjectedSubpatch, P2)},
                                   {"D0", offsetof(ProjectedSubpatch, D0)},
                                   {"D1", offsetof(ProjectedSubpatch, D1)},
                                   {"D2", offsetof(ProjectedSubpatch, D2)},
                                   {"cone", offsetof(ProjectedSubpatch, cone)},
                                   {"sizes", offsetof(ProjectedSubpatch, sizes)}}));
}

TEST(Layout, BvhNode) {
  const Held held = bound_to(BINDING_BVH, spirv_of("trace_bvh"));
  EXPECT_EQ(held.stride, sizeof(BvhNode));
  EXPECT_EQ(held.offsets, (Offsets{{"origin_x", offsetof(BvhNode, origin_x)},
                                   {"origin_y", offsetof(BvhNode, origin_y)},
                                   {"origin_z", offsetof(BvhNode, origin_z)},
                                   {"parent", offsetof(BvhNode, parent)},
                                   {"step_x", offsetof(BvhNode, step_x)},
                                   {"step_y", offsetof(BvhNode, step_y)},
                                   {"step_z", offsetof(BvhNode, step_z)},
                                   {"children", offsetof(BvhNode, children)},
                                   {"boxes", offsetof(BvhNode, boxes)},
                                   {"links", offsetof(BvhNode, links)}}));
}

TEST(Layout, Addresses) {
  const Held held = bound_to(BINDING_ADDRESSES, spirv_of("trace_bvh_at"));
  EXPECT_EQ(held.stride, sizeof(Addresses));
  EXPECT_EQ(held.offsets, (Offsets{{"triangles_low", offsetof(Addresses, triangles_low)},
                                   {"triangles_high", offsetof(Addresses, triangles_high)},
                                   {"subpatches_low", offsetof(Addresses, subpatches_low)},
                                   {"subpatches_high", offsetof(Addresses, subpatches_high)},
                                   {"bvh_low", offsetof(Addresses, bvh_low)},
                                   {"bvh_high", offsetof(Addresses, bvh_high)},
                                   {"boxes_low", offsetof(Addresses, boxes_low)},
                                   {"boxes_high", offsetof(Addresses, boxes_high)},
                                   {"projected_low", offsetof(Addresses, projected_low)},
                                   {"projected_high", offsetof(Addresses, projected_high)},
                                   {"scene_radius", offsetof(Addresses, scene_radius)},
                                   {"padding", offsetof(Addresses, padding)}}));
}

TEST(Layout, TraceParams) {
  const Held held = bound_to(BINDING_PARAMS);
  EXPECT_EQ(held.stride, sizeof(TraceParams));
  EXPECT_EQ(held.offsets, (Offsets{{"eye", offsetof(TraceParams, eye)},
                                   {"ray_corner", offsetof(TraceParams, ray_corner)},
                                   {"ray_dx", offsetof(TraceParams, ray_dx)},
                                   {"ray_dy", offsetof(TraceParams, ray_dy)},
                                   {"anchor", offsetof(TraceParams, anchor)},
                                   {"frame_x", offsetof(TraceParams, frame_x)},
                                   {"frame_y", offsetof(TraceParams, frame_y)},
                                   {"frame_z", offsetof(TraceParams, frame_z)},
                                   {"light", offsetof(TraceParams, light)},
                                   {"grid", offsetof(TraceParams, grid)},
                                   {"color", offsetof(TraceParams, color)},
                                   {"background", offsetof(TraceParams, background)},
                                   {"shading", offsetof(TraceParams, shading)},
                                   {"depth_low", offsetof(TraceParams, depth_low)},
                                   {"depth_high", offsetof(TraceParams, depth_high)},
                                   {"first_x", offsetof(TraceParams, first_x)},
                                   {"first_y", offsetof(TraceParams, first_y)},
                                   {"image_width", offsetof(TraceParams, image_width)},
                                   {"image_height", offsetof(TraceParams, image_height)},
                                   {"padding", offsetof(TraceParams, padding)},
                                   {"width", offsetof(TraceParams, width)},
                                   {"height", offsetof(TraceParams, height)},
                                   {"triangle_count", offsetof(TraceParams, triangle_count)},
                                   {"rank", offsetof(TraceParams, rank)},
                                   {"alpha", offsetof(TraceParams, alpha)},
                                   {"resolution", offsetof(TraceParams, resolution)},
                                   {"min_delta", offsetof(TraceParams, min_delta)},
                                   {"subpatch_count", offsetof(TraceParams, subpatch_count)}}));
}

TEST(Layout, BytesAreThoseOfTheStructures) {
  EXPECT_EQ(sizeof(Triangle), TRIANGLE_BYTES);
  EXPECT_EQ(sizeof(SubpatchBounds), SUBPATCH_BYTES);
  EXPECT_EQ(offsetof(BvhNode, links), BVH_TEST_BYTES);
  EXPECT_EQ(sizeof(BvhNode::links[0]), BVH_LINK_BYTES);
  EXPECT_EQ(sizeof(SubpatchBounds::ball), BALL_BYTES);
  EXPECT_EQ(sizeof(Triangle::Domain), BALL_BYTES);
}

TEST(Layout, TileList) {
  const Held held = bound_to(BINDING_TILE_LISTS, spirv_of("trace_tiles"));
  EXPECT_EQ(held.stride, sizeof(TileList));
  EXPECT_EQ(held.offsets,
            (Offsets{{"count", offsetof(TileList, count)}, {"end", offsetof(TileList, end)}}));
}

TEST(Layout, TileTotals) {
  const Held held = bound_to(BINDING_TILE_TOTALS, spirv_of("fill_sky"));
  EXPECT_EQ(held.stride, sizeof(TileTotals));
  EXPECT_EQ(held.offsets, (Offsets{{"tiles", offsetof(TileTotals, tiles)},
                                   {"entries", offsetof(TileTotals, entries)},
                                   {"padding0", offsetof(TileTotals, padding0)},
                                   {"padding1", offsetof(TileTotals, padding1)}}));
}

TEST(Layout, QueueState) {
  const Held held = bound_to(BINDING_QUEUED);
  EXPECT_EQ(held.stride, sizeof(QueueState));
  EXPECT_EQ(held.offsets, (Offsets{{"now", offsetof(QueueState, now)},
                                   {"queued", offsetof(QueueState, queued)},
                                   {"bytes_low", offsetof(QueueState, bytes_low)},
                                   {"bytes_high", offsetof(QueueState, bytes_high)},
                                   {"all_queued", offsetof(QueueState, all_queued)},
                                   {"begun", offsetof(QueueState, begun)},
                                   {"is_held", offsetof(QueueState, is_held)},
                                   {"groups_x", offsetof(QueueState, groups_x)},
                                   {"groups_y", offsetof(QueueState, groups_y)},
                                   {"groups_z", offsetof(QueueState, groups_z)}}));
}

TEST(Layout, PausedRay) {
  const Held held = bound_to(BINDING_QUEUE);
  EXPECT_EQ(held.stride, sizeof(PausedRay));
  EXPECT_EQ(held.offsets, (Offsets{
                              {"hit", offsetof(PausedRay, hit)},
                              {"triangle", offsetof(PausedRay, triangle)},
                              {"subpatch", offsetof(PausedRay, subpatch)},
                              {"ray", offsetof(PausedRay, ray)},
                              {"item", offsetof(PausedRay, item)},
                              {"path", offsetof(PausedRay, path)},
                              {"evaluations", offsetof(PausedRay, evaluations)},
                              {"candidates", offsetof(PausedRay, candidates)},
                              {"pending_count", offsetof(PausedRay, pending_count)},
                              {"pending", offsetof(PausedRay, pending)},
                          }));
}

TEST(Layout, OutputsAndPushConstants) {
  EXPECT_EQ(bound_to(BINDING_COLOR).stride, sizeof(vec4));
  const Held aovs = bound_to(BINDING_AOVS);
  EXPECT_EQ(aovs.stride, sizeof(PixelAovs));
  EXPECT_EQ(aovs.offsets, (Offsets{{"normal_z", offsetof(PixelAovs, normal_z)},
                                   {"geometric_u", offsetof(PixelAovs, geometric_u)},
                                   {"v", offsetof(PixelAovs, v)},
                                   {"triangle", offsetof(PixelAovs, triangle)},
                                   {"evaluations", offsetof(PixelAovs, evaluations)},
                                   {"candidates", offsetof(PixelAovs, candidates)}}));
  const Compiler compiler = reflect();
  const auto resources = compiler.get_shader_resources();
  ASSERT_EQ(resources.push_constant_buffers.size(), 1U);
  const Held push = held_by(compiler, resources.push_constant_buffers[0]);
  EXPECT_EQ(push.stride, sizeof(TilePush));
  EXPECT_EQ(push.offsets, (Offsets{{"first_group", offsetof(TilePush, first_group)},
                                   {"stride", offsetof(TilePush, stride)},
                                   {"first_row", offsetof(TilePush, first_row)},
                                   {"rows", offsetof(TilePush, rows)},
                                   {"groups", offsetof(TilePush, groups)},
                                   {"listed", offsetof(TilePush, listed)},
                                   {"must_fit", offsetof(TilePush, must_fit)},
                                   {"steps", offsetof(TilePush, steps)},
                                   {"half_queue", offsetof(TilePush, half_queue)}}));
}

TEST(Layout, ScreenPushIsTheFragmentShaders) {
  const Compiler compiler = reflect(spirv_of("screen_frag"));
  const auto resources = compiler.get_shader_resources();
  ASSERT_EQ(resources.push_constant_buffers.size(), 1U);
  const Held push = held_by(compiler, resources.push_constant_buffers[0]);
  EXPECT_EQ(push.stride, sizeof(ScreenPush));
  EXPECT_EQ(push.offsets, (Offsets{{"width", offsetof(ScreenPush, width)},
                                   {"height", offsetof(ScreenPush, height)},
                                   {"frame_width", offsetof(ScreenPush, frame_width)},
                                   {"frame_height", offsetof(ScreenPush, frame_height)},
                                   {"shown", offsetof(ScreenPush, shown)},
                                   {"low", offsetof(ScreenPush, low)},
                                   {"high", offsetof(ScreenPush, high)},
                                   {"padding", offsetof(ScreenPush, padding)}}));
  const gpu::KernelInterface interface = screen_interface();
  EXPECT_EQ(interface.push_size, sizeof(ScreenPush));
  std::set<uint32_t> bindings;
  for (const auto& buffer : resources.storage_buffers) {
    bindings.insert(compiler.get_decoration(buffer.id, spv::DecorationBinding));
  }
  EXPECT_EQ(bindings, (std::set<uint32_t>{BINDING_COLOR, BINDING_AOVS}));
}

TEST(Layout, InterfaceIsTheKernels) {
  std::map<uint32_t, VkDescriptorType> in_kernels;
  for (const KernelSource& source : kernel_sources()) {
    if (source.interface != Interface::frame) continue;
    const Compiler kernel = reflect(source.spirv);
    const auto held = kernel.get_shader_resources();
    for (const auto& buffer : held.uniform_buffers) {
      in_kernels[kernel.get_decoration(buffer.id, spv::DecorationBinding)] =
          VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    }
    for (const auto& buffer : held.storage_buffers) {
      in_kernels[kernel.get_decoration(buffer.id, spv::DecorationBinding)] =
          VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    }
  }
  std::map<uint32_t, VkDescriptorType> in_interface;
  const gpu::KernelInterface interface = frame_interface();
  for (const gpu::Binding& binding : interface.bindings) {
    in_interface[binding.binding] = binding.type;
  }
  EXPECT_EQ(in_kernels, in_interface);
  EXPECT_EQ(interface.push_size, sizeof(TilePush));

  const Compiler compiler = reflect();
  std::map<uint32_t, std::string> constants;
  for (const auto& constant : compiler.get_specialization_constants()) {
    constants[constant.constant_id] = compiler.get_name(constant.id);
  }
  EXPECT_EQ(constants, (std::map<uint32_t, std::string>{{CONSTANT_SURFACE, "SURFACE"},
                                                        {CONSTANT_AOVS, "AOVS"},
                                                        {CONSTANT_SHELL, "SHELL"},
                                                        {CONSTANT_SOLVER, "SOLVER"},
                                                        {CONSTANT_COUNTS, "COUNTS"},
                                                        {CONSTANT_DIVIDED, "DIVIDED"},
                                                        {CONSTANT_NONSMOOTH, "MAY_BE_NONSMOOTH"},
                                                        {CONSTANT_SHADOWS, "SHADOWS"}}));
}

// A module's variables in shared memory.
class SharedMemory : public Compiler {
 public:
  explicit SharedMemory(std::span<const uint32_t> spirv)
      : Compiler(std::vector<uint32_t>(spirv.begin(), spirv.end())) {}

  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = 0;
    ir.for_each_typed_id<spirv_cross::SPIRVariable>([&](auto, const auto& variable) {
      if (variable.storage != spv::StorageClassWorkgroup) return;
      const spirv_cross::SPIRType& type = get_type(variable.basetype);
      std::size_t bytes = std::size_t{type.width} / 8 * type.vecsize * type.columns;
      for (const uint32_t length : type.array) bytes *= length;
      EXPECT_NE(type.basetype, spirv_cross::SPIRType::Struct);
      sum += bytes;
    });
    return sum;
  }
};

// What a device is asked to have is what the largest of the kernels takes.
TEST(Layout, NeedsOfADeviceAreThoseOfTheKernels) {
  uint32_t invocations = 0;
  uint32_t invocations_y = 0;
  std::size_t shared_bytes = 0;
  uint32_t storage_buffers = 0;
  uint32_t uniform_buffers = 0;
  uint32_t push_bytes = 0;
  for (const KernelSource& source : kernel_sources()) {
    const Compiler kernel = reflect(source.spirv);
    if (kernel.get_execution_model() == spv::ExecutionModelGLCompute) {
      const auto size = [&](uint32_t axis) {
        return kernel.get_execution_mode_argument(spv::ExecutionModeLocalSize, axis);
      };
      invocations = std::max(invocations, size(0) * size(1) * size(2));
      invocations_y = std::max(invocations_y, size(1));
      EXPECT_EQ(size(2), 1U) << source.name;
    }
    shared_bytes = std::max(shared_bytes, SharedMemory(source.spirv).bytes());
    const gpu::KernelInterface interface = interface_of(source.name);
    const auto count = [&](VkDescriptorType type) {
      const auto is_type = [type](const gpu::Binding& b) { return b.type == type; };
      return static_cast<uint32_t>(
          std::count_if(interface.bindings.begin(), interface.bindings.end(), is_type));
    };
    storage_buffers = std::max(storage_buffers, count(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER));
    uniform_buffers = std::max(uniform_buffers, count(VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER));
    push_bytes = std::max(push_bytes, interface.push_size);
  }
  using Needs = gpu::KernelNeeds;
  EXPECT_EQ(invocations, uint32_t{Needs::kInvocations});
  EXPECT_EQ(invocations_y, uint32_t{Needs::kInvocationsY});
  EXPECT_EQ(shared_bytes, std::size_t{Needs::kSharedBytes});
  EXPECT_EQ(storage_buffers, uint32_t{Needs::kStorageBuffers});
  EXPECT_EQ(uniform_buffers, uint32_t{Needs::kUniformBuffers});
  EXPECT_EQ(push_bytes, uint32_t{Needs::kPushBytes});
}

// No kernel of any interface binds a buffer, or takes push constants, that its interface lacks.
TEST(Layout, EveryKernelBindsWhatItsInterfaceHas) {
  for (const KernelSource& source : kernel_sources()) {
    const gpu::KernelInterface interface = interface_of(source.name);
    std::set<std::pair<uint32_t, VkDescriptorType>> offered;
    for (const gpu::Binding& binding : interface.bindings) {
      offered.insert({binding.binding, binding.type});
    }
    const Compiler kernel = reflect(source.spirv);
    const auto resources = kernel.get_shader_resources();
    const auto expect_offered = [&](const auto& buffers, VkDescriptorType type) {
      for (const auto& buffer : buffers) {
        const uint32_t binding = kernel.get_decoration(buffer.id, spv::DecorationBinding);
        EXPECT_TRUE(offered.count({binding, type}) > 0) << source.name << " binding " << binding;
      }
    };
    expect_offered(resources.uniform_buffers, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
    expect_offered(resources.storage_buffers, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    for (const auto& push : resources.push_constant_buffers) {
      EXPECT_EQ(held_by(kernel, push).stride, interface.push_size) << source.name;
    }
  }
}

}  // namespace
}  // namespace trisect
