// A user's settings for a frame, and the kernels' parameters that follow from them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "app/bake/bake.h"
#include "app/dispatch/camera.h"
#include "app/frame/image_part.h"
#include "app/mesh/mesh.h"
#include "app/surface/shared.h"

namespace trisect {

// What is seen behind the surface.
enum class Background {
  sky,    // the thesis's
  color,  // TraceSettings::background_color
  none    // black, and where it shows A is 0
};

// Names on the command line and in JSON.
constexpr const char* shading_name(uint shading) {
  switch (shading) {
    case SHADING_PLAIN:
      return "plain";
    case SHADING_GRID:
      return "grid";
    case SHADING_NORMAL:
      return "normal";
    case SHADING_PATCH:
      return "patch";
    default:
      return "depth";
  }
}

constexpr const char* background_name(Background background) {
  return background == Background::sky    ? "sky"
         : background == Background::none ? "transparent"
                                          : "color";
}

// The surface's colour if nobody chooses one: white under the thesis's grid, as there, else a light
// blue, which its warm sky sets off.
inline glm::dvec3 standard_color(uint shading) {
  return shading == SHADING_GRID ? glm::dvec3(1.0) : glm::dvec3(0.62, 0.72, 0.82);
}

// Whether light falls on the surface, and with it shadows.
inline bool is_lit(uint shading) {
  return shading == SHADING_PLAIN || shading == SHADING_GRID;
}

struct TraceSettings {
  uint32_t width = 800;  // of the image in pixels
  uint32_t height = 600;
  std::optional<ImagePart> part;  // that is traced; none: all of it
  Camera camera;
  uint solver = SOLVER_ROBUST;
  uint32_t rank = 10;  // bisection: rank - 1 halvings
  // Bisection: the smallest tolerance, minDelta of the thesis's listing 3.4, whose value is not in
  // the text. With this value the holes close at rank 16 whatever the chord's length. It is in
  // world units, like the listing's constant 1e-3, so it suits models of a size of about 1.
  double min_delta = 1e-4;
  glm::dvec3 light{0.35, 0.8, 0.5};  // toward the light, any length
  uint shading = SHADING_PLAIN;
  // Colours are sRGB-encoded, from 0 to 1. The surface's counts where the shading is lit.
  glm::dvec3 color = standard_color(SHADING_PLAIN);
  bool own_colors = true;  // triangles that have colours show those, on a plain surface
  Background background = Background::sky;
  glm::dvec3 background_color{0.0};
};

// Settings for an image of the whole mesh with the default camera of `trisect render`.
TraceSettings framed_settings(const Mesh& mesh, const BakedScene& scene, uint32_t width,
                              uint32_t height);

// Settings for rays that are cast one by one: their camera is valid, and what it sees means
// nothing.
TraceSettings casting_settings(const BakedScene& scene);

// Throws UsageError if the settings' camera is not valid, as set_rays() does.
TraceParams make_params(const BakedScene& scene, const TraceSettings& settings);

}  // namespace trisect
