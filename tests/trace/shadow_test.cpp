// Shadows, which the curved surface casts on itself and on others.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/cli/data_folder.h"
#include "app/cli/options.h"
#include "app/dispatch/cpu_tracer.h"
#include "app/dispatch/vulkan_tracer.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "app/oracle/oracle_tracer.h"
#include "tests/support/frame_difference.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"
#include "vk/result.h"

namespace trisect {
namespace {

using glm::dvec3;

class Shadows : public test::GpuTest {};

constexpr SurfaceChoice kFlat{SURFACE_FLAT, 0.0, SHELL_NORMAL};
constexpr SurfaceChoice kPhong{SURFACE_PHONG, 0.65, SHELL_NORMAL};
constexpr SurfaceChoice kSphere{SURFACE_SPHERE, 0.0, SHELL_NORMAL};

struct Lit {
  BakedScene scene;
  TraceParams params;
};

// The model as `trisect render` frames it, lit from the side.
Lit lit_from_side(const Mesh& mesh, const SurfaceChoice& choice, uint32_t width, uint32_t height) {
  Lit lit{bake_with_subpatches(mesh, choice), {}};
  lit.scene.bvh = build_bvh(lit.scene);
  TraceSettings settings = test::framed(mesh, lit.scene, width, height, 10);
  settings.solver = SOLVER_ROBUST;
  settings.light = dvec3(1.0, 0.2, 0.4);
  // In shadow everything has the same colour then.
  settings.shading = SHADING_GRID;
  settings.color = standard_color(SHADING_GRID);
  lit.params = make_params(lit.scene, settings);
  return lit;
}

KernelChoice with_shadows(Accel accel) {
  return {SOLVER_ROBUST, true, true, accel, true};
}

Frame trace(const Lit& lit, const KernelChoice& choice, std::size_t buffer_limit = kNoLimit,
            const gpu::Device& device = test::validated_device()) {
  VulkanTracer tracer =
      test::tracer_of(lit.scene, lit.params.width, lit.params.height, choice, buffer_limit, device);
  Frame frame;
  tracer.render(lit.params, frame);
  return frame;
}

// Whether a pixel shows the surface with ambient light alone.
bool is_dark(const vec4& color) {
  return color.w > 0.0F && color.x == 0.25F && color.y == 0.25F && color.z == 0.25F;
}

std::size_t count_dark(const Frame& frame) {
  std::size_t count = 0;
  for (const vec4& color : frame.colors) count += is_dark(color) ? 1 : 0;
  return count;
}

// Pixels that are in shadow in one frame only.
std::size_t count_different(const Frame& a, const Frame& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.colors.size(); ++i) {
    count += is_dark(a.colors[i]) != is_dark(b.colors[i]) ? 1 : 0;
  }
  return count;
}

bool same_colors(const Frame& a, const Frame& b) {
  return std::memcmp(a.colors.data(), b.colors.data(), a.colors.size() * sizeof(vec4)) == 0;
}

TEST_F(Shadows, AreThoseOfTheListByEveryWay) {
  const gpu::Device no_packets(test::validated_instance(), "", VK_NULL_HANDLE, 0);
  const std::pair<const char*, SurfaceChoice> scenes[] = {
      {"torus", kPhong}, {"relief", kPhong}, {"sphere-20", kFlat}, {"sphere-20", kSphere}};
  for (const auto& [name, choice] : scenes) {
    const std::string what = fmt::format("{} {}", name, choice.surface);
    const Lit lit = lit_from_side(test::load_asset(name), choice, 67, 51);
    const Frame list = trace(lit, with_shadows(Accel::list));
    EXPECT_GT(count_dark(list), 50U) << what;
    EXPECT_TRUE(same_colors(list, trace(lit, with_shadows(Accel::tiles)))) << what;
    EXPECT_TRUE(same_colors(list, trace(lit, with_shadows(Accel::bvh)))) << what;
    EXPECT_TRUE(same_colors(list, trace(lit, with_shadows(Accel::bvh), kNoLimit, no_packets)))
        << what;
    Frame cpu;
    trace_on_cpu(lit.scene, lit.params, with_shadows(Accel::list), cpu);
    EXPECT_EQ(count_different(cpu, list), 0U) << what;
  }
}

TEST_F(Shadows, AreThoseOfTheTreeByRayQueries) {
  const Lit lit = lit_from_side(test::load_asset("teapot"), kPhong, 96, 72);
  const auto ours = [&] { return trace(lit, with_shadows(Accel::rayquery)); };
  if (test::validated_device().has_ray_query()) {
    EXPECT_TRUE(same_colors(trace(lit, with_shadows(Accel::bvh)), ours()));
  } else {
    EXPECT_THROW(ours(), gpu::Error);
  }
}

TEST_F(Shadows, FallInEveryBandOfAnImage) {
  const Lit lit = lit_from_side(test::load_asset("sphere-80"), kFlat, 67, 51);
  // Eight rows of 67 pixels of 48 bytes: seven bands.
  constexpr std::size_t limit = 26000;
  EXPECT_TRUE(same_colors(trace(lit, with_shadows(Accel::tiles)),
                          trace(lit, with_shadows(Accel::tiles), limit)));
}

// Nothing but the colours changes. Shadows need the AOVs of the camera rays, but a frame without
// AOVs does not get them.
TEST_F(Shadows, ChangeNothingElse) {
  const Lit lit = lit_from_side(test::load_asset("torus"), kPhong, 67, 51);
  const Frame plain = trace(lit, {SOLVER_ROBUST, true, false, Accel::tiles, false});
  const Frame shadowed = trace(lit, {SOLVER_ROBUST, true, false, Accel::tiles, true});
  const Frame colors = trace(lit, {SOLVER_ROBUST, false, false, Accel::tiles, true});
  const test::FrameDifference apart = test::difference(plain, shadowed);
  EXPECT_EQ(apart.hit_mismatches + apart.patch_mismatches, 0U);
  EXPECT_EQ(apart.depth, 0.0);
  EXPECT_EQ(apart.normal_degrees, 0.0);
  EXPECT_EQ(apart.weights, 0.0);
  EXPECT_TRUE(colors.aovs.empty());
  EXPECT_TRUE(same_colors(colors, shadowed));
  for (std::size_t i = 0; i < plain.colors.size(); ++i) {
    EXPECT_TRUE(is_dark(shadowed.colors[i]) || plain.colors[i] == shadowed.colors[i]) << i;
  }
}

// The oracle traces shadow rays in double precision from the points that the kernel hit.
TEST_F(Shadows, AreWhereTheOracleHasThem) {
  for (const char* name : {"torus", "relief", "teapot"}) {
    const Lit lit = lit_from_side(test::load_asset(name), kPhong, 133, 99);
    const Frame frame = trace(lit, with_shadows(Accel::bvh));
    const Oracle oracle(lit.scene);
    std::size_t wrong = 0;
    std::size_t undecided = 0;
    for (uint32_t y = 0; y < frame.height; ++y) {
      for (uint32_t x = 0; x < frame.width; ++x) {
        const std::size_t i = std::size_t{y} * frame.width + x;
        const PixelAovs& met = frame.aovs[i];
        if (met.triangle == NO_TRIANGLE) continue;
        const auto u = static_cast<double>(met.geometric_u.w);
        const auto v = static_cast<double>(met.v);
        const dvec3 view = oracle_pixel_ray(lit.params, x, y).ray.direction;
        const OracleAnswer answer = oracle_shadow(oracle, lit.scene, lit.params, met.triangle,
                                                  dvec3(1.0 - u - v, u, v), view);
        if (!answer.decidable) {
          ++undecided;
          continue;
        }
        // Where the shading normal faces away from the light, the pixel is dark without a shadow.
        const dvec3 shading(met.normal_z);
        const double seen = glm::dot(shading, view) > 0.0 ? -1.0 : 1.0;
        const bool dark = answer.hit || seen * glm::dot(shading, dvec3(lit.params.light)) <= 0.0;
        if (dark != is_dark(frame.colors[i])) ++wrong;
      }
    }
    EXPECT_EQ(wrong, 0U) << name;
    // The oracle cannot decide rays that leave almost along the surface, near the terminator.
    EXPECT_LT(undecided, frame.hits() / 100) << name;
  }
}

// No tolerance is an absolute length. Scaling by a power of two changes no digit; scaling by
// another factor rounds the vertices differently.
TEST_F(Shadows, AreTheSameAtEveryScale) {
  const Mesh mesh = test::load_asset("teapot");
  const Frame frame = trace(lit_from_side(mesh, kPhong, 133, 99), with_shadows(Accel::tiles));
  for (const double scale : {1.0 / 1024.0, 1e-3, 1e3}) {
    Mesh scaled = mesh;
    for (dvec3& position : scaled.positions) position *= scale;
    const Frame other = trace(lit_from_side(scaled, kPhong, 133, 99), with_shadows(Accel::tiles));
    // One or two pixels on the border of a shadow.
    EXPECT_LE(count_different(frame, other), scale == 1.0 / 1024.0 ? 0U : 2U) << scale;
  }
}

// Near the terminator flat triangles with smooth shading normals cast shadows on pixels that are
// lit on the curved surface which the triangles approximate (Hanika 2021, "Hacking the shadow
// terminator").
class Terminator : public Shadows {
 protected:
  // The number of pixels that are dark though lit_there(lit, pixel) says that the light reaches the
  // true surface there.
  template <typename LitThere>
  static std::size_t count_wrong(const std::string& model, const SurfaceChoice& choice,
                                 const LitThere& lit_there) {
    const Lit lit = lit_from_side(test::load_asset(model), choice, 400, 300);
    const Frame frame = trace(lit, with_shadows(Accel::tiles));
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < frame.colors.size(); ++i) {
      if (is_dark(frame.colors[i]) && lit_there(lit, i)) ++wrong;
    }
    fmt::print("terminator: {}, {}: {} of {} pixels dark though lit\n", model,
               surface_name(choice.surface), wrong, frame.hits());
    return wrong;
  }
};

// A cosine, or a difference of brightness, far above the rounding errors of what is compared.
constexpr double kClearlyLit = 0.02;

TEST_F(Terminator, OfASphere) {
  // The unit sphere about the origin.
  const auto lit_there = [](const Lit& lit, std::size_t i) {
    const uint32_t x = static_cast<uint32_t>(i) % lit.params.width;
    const OracleRay ray =
        oracle_pixel_ray(lit.params, x, static_cast<uint32_t>(i) / lit.params.width).ray;
    const double middle = -glm::dot(ray.origin, ray.direction);
    const double square = 1.0 - glm::dot(ray.origin, ray.origin) + middle * middle;
    if (square < 0.0) return false;
    const dvec3 point = ray.origin + ray.direction * (middle - std::sqrt(square));
    return glm::dot(point, dvec3(lit.params.light)) > kClearlyLit;
  };
  // About a seventh of the pixels with flat triangles, and a hundredth with Phong tessellation. The
  // sphere surface is the sphere itself.
  const std::size_t flat = count_wrong("sphere-20", kFlat, lit_there);
  EXPECT_GT(flat, 5000U);
  EXPECT_LT(count_wrong("sphere-20", kPhong, lit_there), flat / 10);
  EXPECT_EQ(count_wrong("sphere-20", kSphere, lit_there), 0U);
}

TEST_F(Terminator, OfATeapot) {
  // The reference has 4000 curved triangles.
  const std::string path = data_folder("assets", TRISECT_GENERATED_ASSETS) / "teapot-4000.obj";
  const Mesh mesh = build_mesh(read_model(path), path).mesh;
  const Frame fine = trace(lit_from_side(mesh, kPhong, 400, 300), with_shadows(Accel::bvh));
  const auto lit_there = [&](const Lit&, std::size_t i) {
    return fine.colors[i].w > 0.0F && !is_dark(fine.colors[i]) &&
           fine.colors[i].x > 0.25F + static_cast<float>(kClearlyLit);
  };
  // Some of the wrong pixels have another cause: 304 triangles do not have quite the shape of 4000.
  EXPECT_LT(count_wrong("teapot", kPhong, lit_there), count_wrong("teapot", kFlat, lit_there) / 2);
}

}  // namespace
}  // namespace trisect
