#include "app/bench/embree_triangles.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "app/base/error.h"
#include "app/base/threads.h"

namespace trisect::bench {
namespace {

// Embree's memory monitor: adds up what is allocated and freed, and allows every allocation.
bool count_bytes(void* counter, ssize_t bytes, bool) {
  static_cast<std::atomic<ssize_t>*>(counter)->fetch_add(bytes);
  return true;
}

constexpr const char* kNoTriangles =
    "not enough memory for Embree's triangles; take fewer of them or a smaller model.";

template <typename Item>
void copy(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
          const std::vector<Item>& items) {
  void* to = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Item), items.size());
  if (to == nullptr) throw OutOfMemory(kNoTriangles);
  std::copy(items.begin(), items.end(), static_cast<Item*>(to));
}

}  // namespace

EmbreeTriangles::EmbreeTriangles(const std::vector<glm::vec3>& vertices,
                                 const std::vector<glm::uvec3>& triangles)
    : device_(rtcNewDevice(fmt::format("threads={}", worker_threads()).c_str())) {
  rtcSetDeviceMemoryMonitorFunction(device_.get(), count_bytes, &bytes_);
  scene_.reset(rtcNewScene(device_.get()));
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  copy(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices);
  copy(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw OutOfMemory(kNoTriangles);
}

RTCRay embree_ray(const glm::vec3& origin, const glm::vec3& direction) {
  RTCRay ray{};
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tfar = std::numeric_limits<float>::infinity();
  ray.mask = ~0U;
  return ray;
}

}  // namespace trisect::bench
