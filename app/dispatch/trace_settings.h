// What a user asks of a frame, and the trace parameters that follow.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "app/bake/bake.h"
#include "app/dispatch/camera.h"
#include "app/mesh/mesh.h"
#include "app/surface/shared.h"

namespace trisect {

struct TraceSettings {
  uint32_t width = 800;
  uint32_t height = 600;
  Camera camera;
  uint solver = SOLVER_ROBUST;
  uint32_t rank = 10;
  // The listing's minDelta, whose value is lost. With this one the holes close at Rank 16, whatever
  // the chord; like the listing's 1e-3 it is absolute, so it suits models of a size of about 1.
  double min_delta = 1e-4;
  glm::dvec3 light{0.35, 0.8, 0.5};  // toward the light, any length
};

// Of an image of the whole mesh, seen as `trisect render` sees it by default.
TraceSettings framed_settings(const Mesh& mesh, const BakedScene& scene, uint32_t width,
                              uint32_t height);

// Throws UsageError if the camera is none.
TraceParams make_params(const BakedScene& scene, const TraceSettings& settings);

}  // namespace trisect
