#include "app/oracle/oracle_tracer.h"

#include <cmath>

#include "app/base/parallel_rows.h"
#include "app/dispatch/kernel_float.h"
#include "app/surface/surface_double.h"
#include "app/surface/to_double.h"

namespace trisect {

using glm::dvec3;

OraclePixelRay oracle_pixel_ray(const TraceParams& params, uint32_t x, uint32_t y) {
  const double px = params.first_x + x + 0.5;
  const double py = params.first_y + y + 0.5;
  const glm::dvec4 x_axis(params.frame_x);
  const glm::dvec4 y_axis(params.frame_y);
  const glm::dvec4 z_axis(params.frame_z);
  const dvec3 aside = dvec3(x_axis) * (x_axis.w * (px - 0.5 * params.image_width)) +
                      dvec3(y_axis) * (y_axis.w * (py - 0.5 * params.image_height));
  const auto axis = static_cast<double>(params.anchor.w);
  const dvec3 from_eye = dvec3(z_axis) * axis + aside;
  const double anchor_distance = glm::length(from_eye);
  OraclePixelRay pixel{{}, anchor_distance};
  pixel.ray.origin = dvec3(params.anchor) + aside;
  pixel.ray.direction = from_eye / anchor_distance;
  pixel.ray.t_min = z_axis.w * (anchor_distance / axis);
  return pixel;
}

std::optional<OracleFrame> trace_with_oracle(const BakedScene& scene, const TraceParams& params,
                                             const Progress& progress) {
  const Oracle oracle(scene);
  const double motion = kMotion * static_cast<double>(params.anchor.w);
  return oracle_frame(
      oracle, params.width, params.height,
      [&](uint32_t x, uint32_t y) { return oracle_pixel_ray(params, x, y).ray; },
      [&](const OracleRay&) { return motion; }, progress);
}

Frame frame_of(const OracleFrame& answers, const BakedScene& scene, const TraceParams& params) {
  in_float::Kernel kernel = in_float::kernel_of(scene, params, {SOLVER_ROBUST, true, false});
  Frame frame;
  frame.resize(answers.width, answers.height, true);
  for (uint32_t y = 0; y < frame.height; ++y) {
    for (uint32_t x = 0; x < frame.width; ++x) {
      const std::size_t i = std::size_t{y} * frame.width + x;
      const OracleAnswer& answer = answers.pixels[i];
      const double anchor_distance = oracle_pixel_ray(params, x, y).anchor_distance;
      in_float::Hit hit{};
      hit.triangle = answer.hit ? answer.root.triangle : NO_TRIANGLE;
      hit.z = static_cast<float>(anchor_distance + answer.root.t);
      hit.weights = glm::vec3(answer.root.weights);
      kernel.shade_pixel(kernel.pixel_ray({x, y}), hit, frame.colors[i], frame.aovs[i]);
    }
  }
  return frame;
}

OracleAnswer oracle_shadow(const Oracle& oracle, const BakedScene& scene, const TraceParams& params,
                           uint32_t triangle, const dvec3& weights, const dvec3& view) {
  const in_double::Shape shape = shape_of(with_single_alpha(scene.choice));
  const in_double::Triangle tri = to_double(scene.triangles[triangle]);
  const dvec3 light = glm::normalize(dvec3(params.light));
  const dvec3 normal = in_double::facing(in_double::geometric_normal(shape, tri, weights), view);
  if (glm::dot(normal, light) <= 0.0) {
    return {true, true, {0.0, triangle, weights, normal}};
  }
  const OracleRay ray{in_double::shadow_ray_origin(shape, tri, weights, normal), light};
  return oracle.first(ray, kMotion * static_cast<double>(params.anchor.w));
}

bool cast_oracle_shadows(const OracleFrame& answers, const BakedScene& scene,
                         const TraceParams& params, Frame& frame, const Progress& progress) {
  const Oracle oracle(scene);
  const auto row = [&](uint32_t y, const Stopped& stopped) {
    in_float::Kernel kernel = in_float::kernel_of(scene, params, {SOLVER_ROBUST, true, false});
    for (uint32_t x = 0; x < frame.width && !stopped; ++x) {
      const std::size_t i = std::size_t{y} * frame.width + x;
      const OracleRoot& root = answers.pixels[i].root;
      if (!answers.pixels[i].hit) continue;
      const dvec3 view = oracle_pixel_ray(params, x, y).ray.direction;
      if (oracle_shadow(oracle, scene, params, root.triangle, root.weights, view).hit) {
        PixelAovs seen{};
        const dvec3 normal =
            in_double::vertex_normal(to_double(scene.triangles[root.triangle]), root.weights);
        seen.normal_z = vec4(glm::vec3(glm::normalize(normal)), 0.0F);
        seen.triangle = root.triangle;
        frame.colors[i] = kernel.shadow_color(seen, glm::vec3(view));
      }
    }
  };
  return parallel_rows(frame.height, row, progress);
}

}  // namespace trisect
