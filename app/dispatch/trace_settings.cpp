#include "app/dispatch/trace_settings.h"

#include <algorithm>
#include <cmath>

namespace trisect {

TraceSettings framed_settings(const Mesh& mesh, const BakedScene& scene, uint32_t width,
                              uint32_t height) {
  TraceSettings settings;
  settings.width = width;
  settings.height = height;
  settings.camera =
      framing_camera(mesh.positions, scene.origin, settings.camera.fov, settings.camera.up,
                     static_cast<double>(width) / static_cast<double>(height));
  return settings;
}

TraceSettings casting_settings(const BakedScene& scene) {
  TraceSettings settings;
  settings.camera.eye = scene.origin + glm::dvec3(0.0, 0.0, 3.0 * scene.radius);
  settings.camera.target = scene.origin;
  return settings;
}

TraceParams make_params(const BakedScene& scene, const TraceSettings& settings) {
  TraceParams params{};
  const ImagePart part = settings.part.value_or(ImagePart{0, 0, settings.width, settings.height});
  params.width = part.width;
  params.height = part.height;
  params.first_x = part.x;
  params.first_y = part.y;
  params.image_width = settings.width;
  params.image_height = settings.height;
  params.triangle_count = static_cast<uint32_t>(scene.triangles.size());
  params.subpatch_count = static_cast<uint32_t>(scene.subpatches.size());
  params.rank = settings.rank;
  params.alpha = static_cast<float>(scene.choice.alpha);
  params.resolution = static_cast<float>(std::ldexp(1.0, -static_cast<int>(settings.rank)));
  params.min_delta = static_cast<float>(settings.min_delta);
  params.light = vec4(glm::vec3(glm::normalize(settings.light)), 0.0F);
  // Four cells of the shading grid to half the diagonal of the vertices' bounding box: the same
  // grid for every surface of a mesh.
  params.grid = vec4(0.0F, 0.0F, 0.0F, static_cast<float>(4.0 / scene.extent));
  params.shading = settings.shading;
  const bool own = settings.own_colors && scene.has_colors && settings.shading == SHADING_PLAIN;
  params.color = vec4(glm::vec3(settings.color), own ? 1.0F : 0.0F);
  const bool is_color = settings.background == Background::color;
  params.background = vec4(is_color ? glm::vec3(settings.background_color) : glm::vec3(0.0F),
                           settings.background == Background::sky ? 1.0F : 0.0F);
  // The near plane is at a thousandth of the scene's radius, the far plane behind the scene.
  const double near = scene.radius * 1e-3;
  const double far = glm::distance(settings.camera.eye, scene.origin) + scene.radius + near;
  // The scene's ball, as far as it lies before the eye.
  params.depth_low = static_cast<float>(std::max(far - near - 2.0 * scene.radius, 0.0));
  // From very far away the two are one number in single precision.
  params.depth_high =
      std::max(static_cast<float>(far - near), std::nextafterf(params.depth_low, 3e38F));
  set_rays(settings.camera, scene.origin, scene.radius, near, far, params);
  return params;
}

}  // namespace trisect
