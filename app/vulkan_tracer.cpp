#include "app/vulkan_tracer.h"

#include <algorithm>
#include <span>
#include <stdexcept>

#include "app/buffer_limits.h"
#include "app/cage.h"
#include "app/kernels.h"
#include "app/stopwatch.h"
#include "app/workgroups.h"
#include "vk/result.h"

namespace trisect {
namespace {

// Bytes moved between host and device at a time.
constexpr std::size_t kStagingBytes = std::size_t{32} << 20U;

std::vector<gpu::Specialization> constants_of(const BakedScene& scene, const KernelChoice& choice) {
  return {
      {CONSTANT_SURFACE, scene.choice.surface},   {CONSTANT_SHELL, scene.choice.shell},
      {CONSTANT_SOLVER, choice.solver},           {CONSTANT_AOVS, choice.aovs ? 1U : 0U},
      {CONSTANT_COUNTS, choice.counts ? 1U : 0U}, {CONSTANT_GROUPS, has_groups(scene) ? 1U : 0U}};
}

std::optional<TileLists> lists_for(const gpu::Device& device, const BakedScene& scene,
                                   const KernelChoice& choice, uint32_t width, uint32_t band_rows) {
  if (choice.accel != Accel::tiles) return std::nullopt;
  if (device.subgroup_size() == 0) {
    throw gpu::Error(device.report().name +
                     " lacks the subgroup operations of --accel tiles; use --accel list.");
  }
  return std::optional<TileLists>(std::in_place, device, constants_of(scene, choice),
                                  static_cast<uint32_t>(scene.cages.size()), width, band_rows);
}

struct NamedKernel {
  std::span<const uint32_t> spirv;
  const char* name;
};

// What traces new rays, then what goes on with those that it leaves, and so on.
std::vector<NamedKernel> kernel_names(const gpu::Device& device, Accel accel, bool by_address) {
  switch (accel) {
    case Accel::tiles:
      return {{kTraceTilesSpirv, "trace_tiles"}, {kTraceUndecidedSpirv, "trace_undecided"}};
    case Accel::bvh: {
      const NamedKernel alone{by_address ? kTraceBvhAtSpirv : kTraceBvhSpirv, "trace_bvh"};
      // A subgroup tests the eight children of a node at once.
      if (device.subgroup_size() < 8) return {alone};
      return {{by_address ? kTracePacketsAtSpirv : kTracePacketsSpirv, "trace_packets"},
              {by_address ? kSearchPacketsAtSpirv : kSearchPacketsSpirv, "search_packets"},
              alone};
    }
    default:
      return {{kTraceListSpirv, "trace_list"}};
  }
}

std::vector<gpu::Kernel> kernels_for(const gpu::Device& device, const BakedScene& scene,
                                     const KernelChoice& choice, bool by_address) {
  std::vector<gpu::Kernel> kernels;
  for (const NamedKernel& kernel : kernel_names(device, choice.accel, by_address)) {
    kernels.emplace_back(device, kernel.spirv, frame_interface(), constants_of(scene, choice),
                         kernel.name);
  }
  return kernels;
}

}  // namespace

VulkanTracer::VulkanTracer(const gpu::Device& device, const BakedScene& scene, uint32_t width,
                           uint32_t height, const KernelChoice& choice, std::size_t buffer_limit)
    : device_(device),
      width_(width),
      height_(height),
      aovs_(choice.aovs),
      buffer_limit_(std::min<std::size_t>(buffer_limit, device.limits().maxStorageBufferRange)),
      band_rows_(rows_in_a_band(device.report().name, buffer_limit_, width, height, choice.aovs)),
      tiles_(lists_for(device, scene, choice, width, band_rows_)),
      scene_(device, scene, buffer_limit_, choice.accel == Accel::bvh),
      kernels_(kernels_for(device, scene, choice, scene_.by_address())),
      commands_(device),
      staging_(device, kStagingBytes),
      params_(device, sizeof(TraceParams), gpu::Memory::device, "trace parameters"),
      colors_(device, std::size_t{width} * band_rows_ * sizeof(vec4), gpu::Memory::device,
              "colors"),
      // A binding wants a buffer; without AOVs nothing is written to it.
      aovs_buffer_(
          device,
          choice.aovs ? std::size_t{width} * band_rows_ * sizeof(PixelAovs) : sizeof(PixelAovs),
          gpu::Memory::device, "AOVs"),
      queue_(device, groups_of_band(width, 0, band_rows_).most() * kGroupRays),
      unused_(device, sizeof(vec4), gpu::Memory::device, "unused"),
      bound_(device, kernels_[0],
             {&params_, &scene_.triangles(), &colors_, &aovs_buffer_, &scene_.cages(),
              &queue_.paused(), &queue_.queued(), tiles_ ? &tiles_->view_parts() : &unused_,
              tiles_ ? &tiles_->counts() : &unused_, tiles_ ? &tiles_->parts() : &unused_,
              tiles_ ? &tiles_->order() : &unused_, tiles_ ? &tiles_->seen() : &unused_,
              &scene_.bvh(), &scene_.addresses()}) {
  const Stopwatch watch;
  scene_.upload(staging_, commands_, scene);
  upload_ms_ = watch.milliseconds();
}

FrameTime VulkanTracer::render(const TraceParams& params, Frame& frame,
                               const std::function<void()>& between_submits) {
  if (params.width != width_ || params.height != height_) {
    throw std::logic_error("the trace parameters are not for this tracer's image size");
  }
  frame.resize(width_, height_, aovs_);
  const std::span<vec4> colors(frame.colors);
  const std::span<PixelAovs> aovs(frame.aovs);

  const Stopwatch watch;
  FrameTime time;
  staging_.upload(commands_, std::as_bytes(std::span(&params, 1)), params_);
  if (tiles_) time.gpu_ms += tiles_->view(commands_, bound_);
  for (uint32_t row = 0; row < height_; row += band_rows_) {
    const uint32_t rows = std::min(band_rows_, height_ - row);
    time.gpu_ms += render_band(row, rows, between_submits);
    const std::size_t first = std::size_t{row} * width_;
    const std::size_t count = std::size_t{rows} * width_;
    staging_.download(commands_, colors_, std::as_writable_bytes(colors.subspan(first, count)));
    if (aovs_) {
      staging_.download(commands_, aovs_buffer_,
                        std::as_writable_bytes(aovs.subspan(first, count)));
    }
  }
  time.wall_ms = watch.milliseconds();
  return time;
}

double VulkanTracer::render_band(uint32_t first_row, uint32_t rows,
                                 const std::function<void()>& between_submits) {
  GroupRange groups = groups_of_band(width_, first_row, rows);
  double gpu_ms = 0.0;
  if (tiles_) {
    groups.begin = 0;
    gpu_ms = tiles_->bin(commands_, bound_, first_row, rows, groups.end);
  }
  for (uint32_t group = groups.begin; group < groups.end;) {
    const uint32_t count = std::min({budget_.groups(), groups.end - group, groups.most()});
    const double ms = queue_.run(commands_, kernels_, bound_, TilePush{{}, group, first_row, rows},
                                 count, kGroupRays, between_submits);
    gpu_ms += ms;
    group += count;
    budget_.record(count, ms);
    if (between_submits) between_submits();
  }
  return gpu_ms;
}

}  // namespace trisect
