// Flat triangles in Embree's tree.
#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <type_traits>
#include <vector>

namespace trisect::bench {

class EmbreeTriangles {
 public:
  // Throws OutOfMemory if there is not enough memory.
  EmbreeTriangles(const std::vector<glm::vec3>& vertices, const std::vector<glm::uvec3>& triangles);
  EmbreeTriangles(const EmbreeTriangles&) = delete;
  EmbreeTriangles& operator=(const EmbreeTriangles&) = delete;
  EmbreeTriangles(EmbreeTriangles&&) = delete;
  EmbreeTriangles& operator=(EmbreeTriangles&&) = delete;
  ~EmbreeTriangles() = default;

  [[nodiscard]] RTCScene scene() const { return scene_.get(); }

  // Of memory that Embree has.
  [[nodiscard]] std::size_t bytes() const { return static_cast<std::size_t>(bytes_.load()); }

 private:
  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  template <typename Handle>
  using Held = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

  std::atomic<ssize_t> bytes_ = 0;  // until the device is gone
  Held<RTCDevice> device_;
  Held<RTCScene> scene_;
};

// From its origin on, without an end.
RTCRay embree_ray(const glm::vec3& origin, const glm::vec3& direction);

}  // namespace trisect::bench
