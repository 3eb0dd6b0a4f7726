#include "app/dispatch/vulkan_tracer.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "app/base/error.h"
#include "app/base/stopwatch.h"
#include "app/buffers/buffer_limits.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/workgroups.h"
#include "vk/result.h"

namespace trisect {
namespace {

// Bytes moved between host and device at a time.
constexpr std::size_t kStagingBytes = std::size_t{32} << 20U;

// On a device that is processors runs of workgroups that follow each other are so far apart: up to
// that many threads have a share of every part of the image each. On others their scene stays in
// caches if they are neighbours.
constexpr uint32_t kStrideOnProcessors = 16;

std::optional<TileLists> lists_for(const gpu::Device& device, const BakedScene& scene,
                                   const KernelChoice& choice, uint32_t width, uint32_t band_rows,
                                   std::size_t buffer_limit) {
  if (choice.accel != Accel::tiles) return std::nullopt;
  return std::optional<TileLists>(std::in_place, device,
                                  static_cast<uint32_t>(scene.subpatches.size()), width, band_rows,
                                  buffer_limit);
}

// The scene, if it has a tree or needs none. Without a tree its buffer's memory is undefined:
// kernels would take that for a tree and might never come to an end of it, and a packet would write
// beyond its stack.
const BakedScene& with_tree(const BakedScene& scene, const KernelChoice& choice) {
  if (scene.bvh.empty() && needs_bvh(choice.accel, choice.shadows)) {
    throw std::logic_error("the scene has no tree, which its rays need: see build_bvh()");
  }
  return scene;
}

// The most workgroups of a part of a band: those for whose rays the queue has places.
uint32_t groups_of_part(uint32_t width, uint32_t band_rows, std::size_t buffer_limit) {
  const std::size_t places = buffer_limit / (RayQueue::kBytes * kGroupRays);
  const uint32_t most = groups_of_band(width, 0, band_rows).part_limit();
  return static_cast<uint32_t>(std::clamp<std::size_t>(places, 1, most));
}

}  // namespace

VulkanTracer::ImageBuffers::ImageBuffers(const gpu::Device& device, uint32_t width,
                                         uint32_t band_rows, bool with_aovs,
                                         std::size_t buffer_limit)
    : colors(device, std::size_t{width} * band_rows * sizeof(vec4), gpu::Memory::device, "colors"),
      // A binding needs a buffer; without AOVs it has one element that no kernel writes.
      aovs(device, (with_aovs ? std::size_t{width} * band_rows : 1) * sizeof(PixelAovs),
           gpu::Memory::device, "AOVs"),
      queue(device, groups_of_part(width, band_rows, buffer_limit) * kGroupRays) {}

VulkanTracer::VulkanTracer(const gpu::Device& device, const BakedScene& scene, uint32_t width,
                           uint32_t height, const KernelChoice& choice, std::size_t buffer_limit,
                           const KernelCode* code)
    : VulkanTracer(device, scene, width, height, choice, buffer_limit, code, nullptr) {}

VulkanTracer::VulkanTracer(const gpu::Device& device, const BakedScene& scene, uint32_t width,
                           uint32_t height, const KernelChoice& choice,
                           std::shared_ptr<const TracerKernels> kernels)
    : VulkanTracer(device, scene, width, height, choice, kNoLimit, nullptr, std::move(kernels)) {
  if (kernels_->plan() != plan_kernels(device, scene, choice, buffer_limit_)) {
    throw std::logic_error("the kernels are not for this scene and choice");
  }
}

VulkanTracer::VulkanTracer(const gpu::Device& device, const BakedScene& scene, uint32_t width,
                           uint32_t height, const KernelChoice& choice, std::size_t buffer_limit,
                           const KernelCode* code, std::shared_ptr<const TracerKernels> kernels)
    : device_(device),
      width_(width),
      height_(height),
      aovs_(choice.aovs),
      writes_aovs_(choice.writes_aovs()),
      buffer_limit_(std::min<std::size_t>(buffer_limit, device.limits().maxStorageBufferRange)),
      band_rows_(rows_in_a_band(device.report().name, buffer_limit_, width, height, writes_aovs_)),
      tiles_(lists_for(device, scene, choice, width, band_rows_, buffer_limit_)),
      scene_(device, with_tree(scene, choice), buffer_limit_, needs_of(device, choice)),
      kernels_(kernels ? std::move(kernels)
                       : std::make_shared<const TracerKernels>(
                             device, plan_kernels(device, scene, choice, buffer_limit_), code)),
      commands_(device),
      staging_(device, kStagingBytes),
      params_(device, sizeof(TraceParams), gpu::Memory::device, "trace parameters"),
      image_(device, width, band_rows_, writes_aovs_, buffer_limit_),
      unused_(device, sizeof(vec4), gpu::Memory::device, "unused"),
      descriptors_(bind()) {
  const Stopwatch watch;
  if (tiles_ && scene_.by_address()) scene_.set_projected(tiles_->projected());
  scene_.upload(staging_, commands_, scene);
  if (choice.accel == Accel::rayquery) {
    scene_.build_boxes(device, staging_, commands_, scene);
  }
  upload_ms_ = watch.milliseconds();
}

gpu::DescriptorSet VulkanTracer::bind() const {
  return {device_,
          kernels_->begin(),
          {&params_, &scene_.triangles(), &image_.colors, &image_.aovs, &scene_.subpatches(),
           &image_.queue.paused(), &image_.queue.queued(), tiles_ ? &tiles_->projected() : &unused_,
           tiles_ ? &tiles_->lists() : &unused_, tiles_ ? &tiles_->subpatches() : &unused_,
           tiles_ ? &tiles_->order() : &unused_, tiles_ ? &tiles_->totals() : &unused_,
           &scene_.bvh(), &scene_.addresses()}};
}

void VulkanTracer::resize(uint32_t width, uint32_t height) {
  const uint32_t rows =
      rows_in_a_band(device_.report().name, buffer_limit_, width, height, writes_aovs_);
  // If an allocation throws, no frame fits the tracer, and it can be resized again.
  width_ = height_ = band_rows_ = 0;
  image_ = ImageBuffers(device_, width, rows, writes_aovs_, buffer_limit_);
  if (tiles_) tiles_->resize(device_, width, rows);
  descriptors_ = bind();
  width_ = width;
  height_ = height;
  band_rows_ = rows;
}

std::optional<FrameTime> VulkanTracer::render(const TraceParams& params, Frame& frame,
                                              const FractionProgress& progress) {
  if (params.width > width_ || params.height > height_) {
    throw std::logic_error("the trace parameters are not for this tracer's image size");
  }
  const Stopwatch watch;
  FrameTime time;
  frame.resize(params.width, params.height, aovs_);
  for (uint32_t row = 0; row < params.height; row += band_rows_) {
    const uint32_t rows = std::min(band_rows_, params.height - row);
    const double height = params.height;
    const std::optional<double> ms =
        render_band(params, row, rows, part_of(progress, row / height, (row + rows) / height));
    if (!ms) return std::nullopt;
    time.gpu_ms += *ms;
    download_band(row, rows, frame);
  }
  count_work(frame);
  time.wall_ms = watch.milliseconds();
  return time;
}

void VulkanTracer::download_band(uint32_t first_row, uint32_t rows, Frame& frame) {
  const std::size_t first = std::size_t{first_row} * frame.width;
  const std::size_t count = std::size_t{rows} * frame.width;
  const std::span<vec4> colors(frame.colors);
  staging_.download(commands_, image_.colors, std::as_writable_bytes(colors.subspan(first, count)));
  if (!aovs_) return;
  const std::span<PixelAovs> aovs(frame.aovs);
  staging_.download(commands_, image_.aovs, std::as_writable_bytes(aovs.subspan(first, count)));
}

void VulkanTracer::count_work(Frame& frame) const {
  const QueueState state = image_.queue.state();
  frame.bytes_read = bytes_in(state);
  frame.queued_rays = state.all_queued;
}

void VulkanTracer::fetch(const TraceParams& params, Frame& frame) {
  frame.resize(params.width, params.height, aovs_);
  count_work(frame);
  download_band(0, params.height, frame);
}

std::optional<double> VulkanTracer::trace(const TraceParams& params,
                                          const FractionProgress& progress) {
  if (!holds_at_once(params.width, params.height)) {
    throw std::logic_error("the frame does not fit into the output buffers");
  }
  return render_band(params, 0, params.height, progress);
}

std::optional<double> VulkanTracer::render_band(const TraceParams& params, uint32_t first_row,
                                                uint32_t rows, const FractionProgress& progress) {
  const GroupRange all = groups_of_band(params.width, first_row, rows);
  const GroupRange listed{0, all.end - all.begin};
  BandParts band(tiles_ ? listed : all, kernels_->shadow_rays().empty() ? GroupRange{0, 0} : all);
  const KeepGoing keep_going = [&] { return may_go_on(progress, band.part_done()); };
  bool begins_frame = first_row == 0;
  bool has_lists = !tiles_.has_value();
  double gpu_ms = 0.0;
  while (!band.is_done()) {
    commands_.begin();
    if (begins_frame) record_frame(params);
    begins_frame = false;
    if (!has_lists) tiles_->bin(commands_, *kernels_, descriptors_, params.width, first_row, rows);
    commands_.mark();
    image_.queue.begin_parts(commands_);
    std::vector<BandParts::Part> parts =
        band.next(budget_.groups(), image_.queue.rays() / kGroupRays);
    for (const BandParts::Part& part : parts) record_part(part, first_row, rows);
    image_.queue.read_state(commands_);
    gpu_ms += commands_.submit_and_wait();

    if (!has_lists) {
      if (tiles_->grow(device_)) {
        descriptors_ = bind();
        continue;
      }
      has_lists = true;
      band.end_camera_at(tiles_->tiles_seen());
    }
    // If rays of a part are left, those after it have not begun.
    const uint32_t begun = image_.queue.state().begun;
    if (begun == 0 || begun > parts.size()) {
      throw DeviceError(device_.report().name + " began " + std::to_string(begun) + " of " +
                        std::to_string(parts.size()) + " parts of a frame.");
    }
    parts.resize(begun);
    const uint32_t groups = band.finish(parts);
    if (groups > 0) budget_.record(groups, commands_.ms_since_mark());
    const std::optional<double> ms = finish_rays(parts.back(), first_row, rows, keep_going);
    if (!ms || !may_go_on(keep_going)) return std::nullopt;
    gpu_ms += *ms;
  }
  return gpu_ms;
}

void VulkanTracer::record_frame(const TraceParams& params) {
  commands_.update(params_, 0, std::as_bytes(std::span(&params, 1)));
  image_.queue.begin_frame(commands_);
  if (tiles_) tiles_->project(commands_, *kernels_, descriptors_);
}

void VulkanTracer::record_part(const BandParts::Part& part, uint32_t first_row, uint32_t rows) {
  const bool listed = tiles_.has_value() && !part.shadows;
  const TilePush push{.first_group = part.first,
                      .stride = device_.is_processor() ? kStrideOnProcessors : 1,
                      .first_row = first_row,
                      .rows = rows,
                      .groups = part.count,
                      .listed = listed ? 1U : 0U,
                      .must_fit = listed && tiles_->can_grow() ? 1U : 0U,
                      .steps = image_.queue.steps(),
                      .half_queue = image_.queue.rays()};
  const std::span<const std::byte> bytes = std::as_bytes(std::span(&push, 1));
  commands_.dispatch(kernels_->begin(), descriptors_, bytes, 1);
  for (const gpu::Kernel& kernel : kernels_of(part)) {
    commands_.dispatch_indirect(kernel, descriptors_, bytes, image_.queue.queued(),
                                offsetof(QueueState, groups_x));
    commands_.dispatch(kernels_->next(), descriptors_, bytes, 1);
  }
}

std::optional<double> VulkanTracer::finish_rays(const BandParts::Part& part, uint32_t first_row,
                                                uint32_t rows, const KeepGoing& keep_going) {
  const TilePush push{.first_group = part.first, .stride = 1, .first_row = first_row, .rows = rows};
  const std::span<const std::byte> bytes = std::as_bytes(std::span(&push, 1));
  double gpu_ms = 0.0;
  for (QueueState state = image_.queue.state(); state.now.resumed > 0;
       state = image_.queue.state()) {
    if (!may_go_on(keep_going)) return std::nullopt;
    commands_.begin();
    image_.queue.begin_parts(commands_);
    commands_.dispatch(kernels_of(part).back(), descriptors_, bytes,
                       (state.now.resumed + kGroupRays - 1) / kGroupRays);
    commands_.dispatch(kernels_->next(), descriptors_, bytes, 1);
    image_.queue.read_state(commands_);
    gpu_ms += commands_.submit_and_wait();
  }
  return gpu_ms;
}

}  // namespace trisect
