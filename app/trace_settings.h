// What a user asks of a frame, and the trace parameters that follow.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "app/bake.h"
#include "app/camera.h"
#include "app/shared.h"

namespace trisect {

struct TraceSettings {
  uint32_t width = 800;
  uint32_t height = 600;
  Camera camera;
  uint32_t rank = 10;
  // The listing's minDelta, whose value is lost: this one closes the holes at Rank 16, not before,
  // as the thesis's pictures do at the sizes of its models.
  double min_delta = 1e-4;
  glm::dvec3 light{0.35, 0.8, 0.5};  // toward the light, any length
};

// Throws UsageError if the camera is none.
TraceParams make_params(const BakedScene& scene, const TraceSettings& settings);

}  // namespace trisect
