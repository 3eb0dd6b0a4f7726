// A user's settings for a frame, and the kernels' parameters that follow from them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "app/bake/bake.h"
#include "app/dispatch/camera.h"
#include "app/mesh/mesh.h"
#include "app/surface/shared.h"

namespace trisect {

struct TraceSettings {
  uint32_t width = 800;  // of the image in pixels
  uint32_t height = 600;
  Camera camera;
  uint solver = SOLVER_ROBUST;
  uint32_t rank = 10;  // bisection: rank - 1 halvings
  // Bisection: the smallest tolerance, minDelta of the thesis's listing 3.4, whose value is not in
  // the text. With this value the holes close at rank 16 whatever the chord's length. It is in
  // world units, like the listing's constant 1e-3, so it suits models of a size of about 1.
  double min_delta = 1e-4;
  glm::dvec3 light{0.35, 0.8, 0.5};  // toward the light, any length
};

// Settings for an image of the whole mesh with the default camera of `trisect render`.
TraceSettings framed_settings(const Mesh& mesh, const BakedScene& scene, uint32_t width,
                              uint32_t height);

// Throws UsageError if the settings' camera is not valid, as set_rays() does.
TraceParams make_params(const BakedScene& scene, const TraceSettings& settings);

}  // namespace trisect
