#include "app/view/error_overlay.h"

#include <cstring>
#include <utility>

namespace trisect::view {

void ErrorOverlay::start(const FrameContent& content, std::shared_ptr<const BakedScene> scene,
                         const TraceParams& params, Frame frame) {
  content_ = content;
  map_ = {};
  measurement_.start(std::move(scene), params, std::move(frame));
}

bool ErrorOverlay::poll() {
  std::optional<ErrorMap> map = measurement_.poll();
  if (!map) return false;
  map_ = std::move(*map);
  return true;
}

void ErrorOverlay::upload(const gpu::Device& device) {
  const std::size_t bytes = map_.errors.size() * sizeof(vec4);
  buffer_.emplace(device, bytes, gpu::Memory::host, "errors");
  std::memcpy(buffer_->bytes().data(), map_.errors.data(), bytes);
}

bool ErrorOverlay::belongs_to(const FrameContent& content) const {
  if (!has_map()) return false;
  FrameContent compared = content;
  compared.kernels = content_.kernels;
  return compared == content_;
}

}  // namespace trisect::view
