#include "app/bench/terminator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "app/base/parallel_rows.h"
#include "app/base/stopwatch.h"
#include "app/bench/contender.h"
#include "app/bench/embree_triangles.h"
#include "app/bench/model_steps.h"
#include "app/bench/terminator_fixes.h"
#include "app/bench/tessellation.h"
#include "app/cli/interrupt.h"
#include "app/cli/progress_line.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/kernel_float.h"
#include "app/frame/draw_text.h"
#include "app/mesh/obj_file.h"
#include "app/oracle/oracle_tracer.h"
#include "app/surface/surface_double.h"
#include "app/surface/to_double.h"

namespace trisect::bench {
namespace {

using glm::dvec3;
using glm::vec3;
using in_float::Kernel;

enum class Fix { none, offset, tangent_planes, envelope, softening, no_shadows };

// A way to cast shadows of flat triangles.
struct FlatShadows {
  std::string name;
  Fix fix = Fix::none;
  float offset = 0.0F;  // by which the ray begins off the triangle, over the mean edge
};

const std::vector<FlatShadows>& ways() {
  static const std::vector<FlatShadows> all{{"flat", Fix::none, 0.0F},
                                            {"flat, offset 1%", Fix::offset, 0.01F},
                                            {"flat, offset 10%", Fix::offset, 0.1F},
                                            {"Hanika 2021", Fix::tangent_planes, 0.0F},
                                            {"Cycles", Fix::envelope, 0.0F},
                                            {"Chiang 2019", Fix::softening, 0.0F},
                                            {kNoShadows, Fix::no_shadows, 0.0F}};
  return all;
}

// All shadow rays of flat triangles begin so far off their triangle, over the scene's radius, or
// they would hit it for their roundings.
constexpr float kOffTriangle = 1e-5F;

// What the light does to a pixel.
struct Lit {
  bool is_seen = false;  // there is a surface, and of the truth, what the light does is certain
  bool is_lit = false;
  float brightness = 0.0F;  // the cosine between light and interpolated normal, 0 in shadow
};

using LitPixels = std::vector<Lit>;

// Of a surface that is seen, whose normal has this cosine with the light.
Lit lit_by(float cosine, bool in_shadow) {
  const bool is_lit = cosine > 0.0F && !in_shadow;
  return {true, is_lit, is_lit ? cosine : 0.0F};
}

// The direction toward a light: off the direction toward the eye by that angle, to the right and 30
// degrees up.
dvec3 light_at(double degrees, const Camera& camera) {
  const dvec3 back = glm::normalize(camera.eye - camera.target);
  const dvec3 right = glm::normalize(glm::cross(camera.up, back));
  const dvec3 up = glm::cross(back, right);
  const double angle = glm::radians(degrees);
  const double slope = glm::radians(30.0);
  return std::cos(angle) * back +
         std::sin(angle) * (std::cos(slope) * right + std::sin(slope) * up);
}

// By the oracle.
LitPixels truth(const Oracle& oracle, const OracleFrame& seen, const BakedScene& scene,
                const TraceParams& params) {
  LitPixels pixels(seen.pixels.size());
  ProgressLine line("casting the oracle's shadows", seen.height);
  parallel_rows(
      seen.height,
      [&](uint32_t y, const Stopped& stopped) {
        for (uint32_t x = 0; x < seen.width && !stopped; ++x) {
          const std::size_t i = std::size_t{y} * seen.width + x;
          const OracleAnswer& answer = seen.pixels[i];
          if (!answer.hit || !answer.decidable) continue;
          const dvec3 view = oracle_pixel_ray(params, x, y).ray.direction;
          const OracleAnswer shadow =
              oracle_shadow(oracle, scene, params, answer.root.triangle, answer.root.weights, view);
          const dvec3 normal = in_double::facing(
              glm::normalize(in_double::vertex_normal(
                  to_double(scene.triangles[answer.root.triangle]), answer.root.weights)),
              view);
          const double cosine = glm::dot(normal, glm::normalize(dvec3(params.light)));
          if (shadow.decidable) pixels[i] = lit_by(static_cast<float>(cosine), shadow.hit);
        }
      },
      [&](uint32_t rows) { return line.show(rows); });
  stop_if_interrupted();
  return pixels;
}

// The curved surface on the device, in one light.
class CurvedShadows {
 public:
  // Kernels that cast shadows, and some that do not.
  struct Pair {
    std::shared_ptr<Kernels> shadowed;
    std::shared_ptr<Kernels> open;
  };
  static Pair kernels(const gpu::Device& device, const BakedScene& scene,
                      const TraceParams& params) {
    const auto made = [&](bool shadows) {
      const AccelRequest request{.shadows = shadows,
                                 .width = params.width,
                                 .height = params.height,
                                 .subgroups = device.subgroup_size() != 0};
      return kernels_for(
          device, scene,
          {.solver = SOLVER_ROBUST, .accel = accel_at_hand(request, scene), .shadows = shadows});
    };
    return {made(true), made(false)};
  }

  CurvedShadows(const Pair& kernels, const BakedScene& scene, const TraceParams& params)
      : params_(params),
        kernel_(in_float::kernel_of(scene, params_, {})),
        shadowed_(on_vulkan(kernels.shadowed, params)),
        open_(on_vulkan(kernels.open, params)) {}

  LitPixels cast() {
    Frame dark;
    Frame open;
    shadowed_->inspect(dark);
    open_->inspect(open);
    LitPixels pixels(dark.colors.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const PixelAovs& hit = dark.aovs[i];
      if (hit.triangle == NO_TRIANGLE) continue;
      const auto x = static_cast<uint32_t>(i % params_.width);
      const auto y = static_cast<uint32_t>(i / params_.width);
      const vec3 view(oracle_pixel_ray(params_, x, y).ray.direction);
      const float cosine =
          glm::dot(in_float::facing(vec3(hit.normal_z), view), vec3(params_.light));
      // The frame has one of two colours there, but for roundings.
      const auto off = [&](const vec4& color) {
        return glm::length(vec3(dark.colors[i]) - vec3(color));
      };
      const bool is_dark = off(kernel_.shadow_color(hit, view)) < off(open.colors[i]);
      pixels[i] = lit_by(cosine, is_dark);
    }
    return pixels;
  }

  [[nodiscard]] Contender& shadowed() const { return *shadowed_; }

 private:
  TraceParams params_;
  Kernel kernel_;
  std::unique_ptr<Contender> shadowed_;
  std::unique_ptr<Contender> open_;
};

// The same model's flat triangles in Embree.
class FlatModel {
 public:
  explicit FlatModel(const BakedScene& scene)
      : scene_(scene), radius_(static_cast<float>(scene.radius)), triangles_(embree(scene)) {
    double length = 0.0;
    for (const Triangle& tri : scene.triangles) {
      for (int k = 0; k < 3; ++k) {
        length += glm::length(vec3(tri.Position[k]) - vec3(tri.Position[(k + 1) % 3]));
      }
    }
    mean_edge_ = static_cast<float>(length / (3.0 * static_cast<double>(scene.triangles.size())));
  }

  LitPixels cast(const FlatShadows& way, const TraceParams& params) const {
    LitPixels pixels(std::size_t{params.width} * params.height);
    const Kernel prototype = in_float::kernel_of(scene_, params, {});
    parallel_rows(
        params.height,
        [&](uint32_t y) {
          Kernel kernel = prototype;
          for (uint32_t x = 0; x < params.width; ++x) {
            pixels[std::size_t{y} * params.width + x] =
                lit(way, kernel.pixel_ray({x, y}), vec3(params.light));
          }
        },
        [](uint32_t) { return not_interrupted(); });
    stop_if_interrupted();
    return pixels;
  }

 private:
  static EmbreeTriangles embree(const BakedScene& scene) {
    const Tessellation flat = tessellate(scene, 1);
    return {flat.vertices, flat.triangles};
  }

  Lit lit(const FlatShadows& way, const Kernel::PixelRay& ray, const vec3& light) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit seen{};
    seen.ray = embree_ray(ray.near_point, ray.view);
    seen.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(triangles_.scene(), &context, &seen);
    if (seen.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};

    const Triangle& tri = scene_.triangles[seen.hit.primID];
    const vec3 face = in_float::facing(vec3(tri.TriNormal), ray.view);
    const float side = glm::dot(face, vec3(tri.TriNormal)) < 0.0F ? -1.0F : 1.0F;
    const SmoothPoint point{
        {vec3(tri.Position[0]), vec3(tri.Position[1]), vec3(tri.Position[2])},
        {side * vec3(tri.Normal[0]), side * vec3(tri.Normal[1]), side * vec3(tri.Normal[2])},
        vec3(1.0F - seen.hit.u - seen.hit.v, seen.hit.u, seen.hit.v)};
    const vec3 normal = point.normal();
    const float cosine = glm::dot(normal, light);
    const float dimmed = way.fix == Fix::softening ? softening(face, normal, light) : 1.0F;
    // Without a ray where no light falls anyway.
    if (!(dimmed * cosine > 0.0F)) return lit_by(0.0F, true);
    RTCRay shadow =
        embree_ray(begin(way, point, face, light) + kOffTriangle * radius_ * face, light);
    if (way.fix != Fix::no_shadows) rtcOccluded1(triangles_.scene(), &context, &shadow);
    // Embree marks a ray that is occluded by a negative end.
    return lit_by(dimmed * cosine, shadow.tfar < 0.0F);
  }

  [[nodiscard]] vec3 begin(const FlatShadows& way, const SmoothPoint& point, const vec3& face,
                           const vec3& light) const {
    switch (way.fix) {
      case Fix::offset:
        return point.position() + way.offset * mean_edge_ * face;
      case Fix::tangent_planes:
        return on_tangent_planes(point);
      case Fix::envelope:
        return under_envelope(point, face, light);
      default:
        return point.position();
    }
  }

  const BakedScene& scene_;
  float radius_;
  float mean_edge_ = 0.0F;
  EmbreeTriangles triangles_;
};

void compare(const LitPixels& pixels, const LitPixels& truth, const LitPixels& flat,
             TerminatorRow& row) {
  double squares = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!truth[i].is_seen || !pixels[i].is_seen || !flat[i].is_seen) continue;
    ++row.pixels;
    row.lit += truth[i].is_lit ? 1 : 0;
    row.dark += truth[i].is_lit && !pixels[i].is_lit ? 1 : 0;
    row.bright += !truth[i].is_lit && pixels[i].is_lit ? 1 : 0;
    const double off = static_cast<double>(pixels[i].brightness) - truth[i].brightness;
    squares += off * off;
  }
  row.rmse = row.pixels == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(row.pixels));
}

// Pictures beside each other, with names above and the lights' angles in them.
class Sheet {
 public:
  Sheet(uint32_t columns, std::size_t rows, uint32_t width, uint32_t height)
      : width_(width), height_(height) {
    frame_.resize(columns * (width + kGap), kHead + static_cast<uint32_t>(rows) * (height + kGap),
                  false);
    std::fill(frame_.colors.begin(), frame_.colors.end(), vec4(1.0F));
  }

  void add(uint32_t column, std::size_t row, const std::string& name, const LitPixels& pixels,
           double degrees) {
    const uint32_t left = column * (width_ + kGap);
    const uint32_t top = kHead + static_cast<uint32_t>(row) * (height_ + kGap);
    if (row == 0) draw_text(left + kGap, kGap, name, vec4(0.0F, 0.0F, 0.0F, 1.0F), frame_);
    for (uint32_t y = 0; y < height_; ++y) {
      for (uint32_t x = 0; x < width_; ++x) {
        const Lit& pixel = pixels[std::size_t{y} * width_ + x];
        // A root stands for sRGB's curve. Some light comes from all around.
        const float grey = pixel.is_seen ? std::sqrt(0.03F + 0.9F * pixel.brightness) : 0.35F;
        frame_.colors[std::size_t{top + y} * frame_.width + left + x] =
            vec4(grey, grey, grey, 1.0F);
      }
    }
    draw_text(left + kGap, top + kGap, fmt::format("{:g} degrees", degrees),
              vec4(1.0F, 1.0F, 1.0F, 1.0F), frame_);
  }

  Frame take() { return std::move(frame_); }

 private:
  static constexpr uint32_t kGap = 4;
  static constexpr uint32_t kHead = kTextHeight + 2 * kGap;

  uint32_t width_;
  uint32_t height_;
  Frame frame_;
};

// A way with its times.
struct Timed {
  TerminatorRow row;
  std::function<Timing()> turn;
  std::vector<double> times;
};

void measure_model(const gpu::Device& device, const std::string& file,
                   const TerminatorOptions& options, Terminator& result) {
  const Mesh mesh = read_mesh(file);
  BakedScene scene = baked(file, mesh, options.surface);
  add_tree(scene);
  TraceSettings settings = framed_settings(mesh, scene, options.width, options.height);
  settings.own_colors = false;
  const OracleFrame seen = [&] {
    ProgressLine line("tracing with the oracle", options.height);
    return finished(trace_with_oracle(scene, make_params(scene, settings),
                                      [&](uint32_t rows) { return line.show(rows); }));
  }();
  const Oracle oracle(scene);
  const FlatModel flat(scene);
  const CurvedShadows::Pair kernels =
      CurvedShadows::kernels(device, scene, make_params(scene, settings));
  Sheet sheet(static_cast<uint32_t>(ways().size()) + 2, options.lights.size(), options.width,
              options.height);
  for (std::size_t k = 0; k < options.lights.size(); ++k) {
    settings.light = light_at(options.lights[k], settings.camera);
    const TraceParams params = make_params(scene, settings);
    const LitPixels right = truth(oracle, seen, scene, params);
    sheet.add(0, k, "truth", right, options.lights[k]);
    const LitPixels plain = flat.cast(ways().front(), params);
    std::vector<Timed> timed;
    const auto add = [&](const std::string& shadows, const LitPixels& pixels, auto&& turn_ms) {
      Timed one{{model_name(file), mesh.triangles.size(), options.lights[k], shadows}, turn_ms, {}};
      compare(pixels, right, plain, one.row);
      timed.push_back(std::move(one));
      sheet.add(static_cast<uint32_t>(timed.size()), k, shadows, pixels, options.lights[k]);
    };
    CurvedShadows curved(kernels, scene, params);
    Frame frame;
    add("curved", curved.cast(), [&] { return take_turn(curved.shadowed(), frame); });
    for (const FlatShadows& way : ways()) {
      const bool is_plain = &way == &ways().front();
      add(way.name, is_plain ? plain : flat.cast(way, params), [&flat, &params, &way = way] {
        return take_turn([&]() -> Timing {
          const Stopwatch watch;
          flat.cast(way, params);
          return {.ms = watch.milliseconds()};
        });
      });
    }
    ProgressLine line("timing frames", options.runs);
    for (Timed& one : timed) one.turn();
    for (uint32_t run = 0; run < options.runs; ++run) {
      for (Timed& one : timed) {
        one.times.push_back(one.turn().ms);
        stop_if_interrupted();
      }
      line.show(run + 1);
    }
    for (Timed& one : timed) {
      one.row.ms = spread_of(one.times);
      result.rows.push_back(std::move(one.row));
    }
  }
  result.sheets.push_back(sheet.take());
}

}  // namespace

Terminator measure_terminator(const gpu::Device& device, const TerminatorOptions& options) {
  Terminator result;
  for (const std::string& file : options.models) measure_model(device, file, options, result);
  return result;
}

}  // namespace trisect::bench
