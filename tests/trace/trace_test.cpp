// The kernel's frames are compared with analytic solutions and with each other.
#include <gtest/gtest.h>

#include <cmath>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/cli/options.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/vulkan_tracer.h"
#include "tests/support/frame_difference.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"
#include "vk/result.h"

namespace trisect {
namespace {

using glm::dvec3;

class Trace : public test::GpuTest {};

// The kernel's ray through a pixel's centre, in double precision, relative to the scene's origin.
struct PixelRay {
  dvec3 eye;
  dvec3 direction;
};
PixelRay pixel_ray(const TraceParams& params, uint32_t x, uint32_t y) {
  const dvec3 to_near = dvec3(params.ray_corner) + dvec3(params.ray_dx) * (x + 0.5) +
                        dvec3(params.ray_dy) * (y + 0.5);
  return {dvec3(params.eye), glm::normalize(to_near)};
}

// Where a ray meets the plane of a triangle from the front: the distance, and the smallest of the
// barycentric weights, which is negative outside of the triangle.
struct Meeting {
  double distance;
  double inside;
};
Meeting meet(const PixelRay& ray, const Triangle& tri) {
  const dvec3 P0(tri.Position[0]);
  const dvec3 e1 = dvec3(tri.Position[1]) - P0;
  const dvec3 e2 = dvec3(tri.Position[2]) - P0;
  const dvec3 n = glm::cross(e1, e2);
  const double slope = glm::dot(n, ray.direction);
  if (slope >= 0.0) return {0.0, -1.0};
  const double t = glm::dot(n, P0 - ray.eye) / slope;
  const dvec3 p = ray.eye + ray.direction * t - P0;
  const double v = glm::dot(glm::cross(p, e2), n) / glm::dot(n, n);
  const double w = glm::dot(glm::cross(e1, p), n) / glm::dot(n, n);
  return {t, std::min({1.0 - v - w, v, w})};
}

TEST_F(Trace, FlatIsThePlainTriangle) {
  for (const char* name : {"sphere-80", "teapot", "relief", "cube"}) {
    const Mesh mesh = test::load_asset(name);
    const BakedScene scene = bake(mesh, {SURFACE_FLAT, 0.0});
    const TraceSettings settings = test::framed(mesh, scene, 120, 90, 10);
    const TraceParams params = make_params(scene, settings);
    const Frame frame = test::trace(scene, settings);
    std::size_t undecided = 0;
    std::size_t hits = 0;
    for (uint32_t y = 0; y < 90; ++y) {
      for (uint32_t x = 0; x < 120; ++x) {
        const PixelRay ray = pixel_ray(params, x, y);
        double nearest = std::numeric_limits<double>::infinity();
        bool on_edge = false;
        for (const Triangle& tri : scene.triangles) {
          const Meeting m = meet(ray, tri);
          // Single precision changes a weight by about 1e-6: so near an edge both hit and miss are
          // right.
          on_edge = on_edge || std::abs(m.inside) < 1e-5;
          if (m.inside >= 0.0 && m.distance < nearest) nearest = m.distance;
        }
        if (on_edge) {
          ++undecided;
          continue;
        }
        const PixelAovs& aov = frame.aovs[y * 120 + x];
        const bool hit = std::isfinite(nearest);
        hits += hit ? 1 : 0;
        ASSERT_EQ(aov.triangle != NO_TRIANGLE, hit) << name << " " << x << "," << y;
        // Coordinates as large as the depth are rounded by 6e-8 of it. Where the ray is oblique to
        // the triangle that error is magnified, in this image by up to 100.
        if (!hit) continue;
        ASSERT_NEAR(static_cast<double>(aov.normal_z.w), nearest, 1e-5 * nearest) << name;
      }
    }
    EXPECT_GT(hits, 1000U) << name;
    EXPECT_LT(undecided, 20U) << name;
  }
}

TEST_F(Trace, CurvedSurfacesWithFlatNormalsAreFlat) {
  // At rank 24 the bisection's last step is smaller than the rounding errors of single precision.
  const Mesh mesh = test::load_asset("cube");
  const BakedScene flat = bake(mesh, {SURFACE_FLAT, 0.0});
  const TraceSettings settings = test::framed(mesh, flat, 160, 120, 24);
  const Frame expected = test::trace(flat, settings);
  for (const uint surface : {SURFACE_PHONG, SURFACE_SPHERE}) {
    const Frame frame = test::trace(bake(mesh, {surface, 0.65, SHELL_HEIGHT}), settings);
    const test::FrameDifference d = test::difference(expected, frame);
    ASSERT_TRUE(d.same_size);
    // A ray that meets an edge up to rounding errors may hit either triangle.
    EXPECT_LE(d.hit_mismatches, 2U) << "surface " << surface;
    EXPECT_LE(d.patch_mismatches, 2U) << "surface " << surface;
    // The bisection accepts points where the field is up to minDelta, 1e-4; along rays whose angle
    // to the surface has a sine of 1/4 that is four times as far.
    EXPECT_LE(d.depth, 4e-4) << "surface " << surface;
    EXPECT_LE(d.normal_degrees, 0.01) << "surface " << surface;
  }
}

TEST_F(Trace, AlphaZeroIsFlat) {
  const Mesh mesh = test::load_asset("relief");
  const BakedScene flat = bake(mesh, {SURFACE_FLAT, 0.0});
  TraceSettings settings = test::framed(mesh, flat, 160, 120, 24);
  // Seen from straight in front, where no vertex normal faces away from the eye: the bisection uses
  // their signs.
  settings.camera.eye = {0, 0, 4};
  const test::FrameDifference d =
      test::difference(test::trace(flat, settings),
                       test::trace(bake(mesh, {SURFACE_PHONG, 0.0, SHELL_HEIGHT}), settings));
  // At the outline and at edges: the bisection accepts points up to minDelta, 1e-4, off the
  // surface.
  EXPECT_LE(d.hit_mismatches, 4U);
  EXPECT_LE(d.patch_mismatches, 4U);
  // The same along a ray whose angle to the surface has a sine of 1/4.
  EXPECT_LE(d.depth, 4e-4);
}

TEST_F(Trace, SphereSurfaceLiesOnTheUnitSphere) {
  for (const char* name : {"sphere-20", "sphere-80", "sphere-320"}) {
    const Mesh mesh = test::load_asset(name);
    const BakedScene scene = bake(mesh, {SURFACE_SPHERE, 0.0, SHELL_HEIGHT});
    for (const uint32_t rank : {10U, 20U}) {
      const TraceSettings settings = test::framed(mesh, scene, 160, 120, rank);
      const TraceParams params = make_params(scene, settings);
      const Frame frame = test::trace(scene, settings);
      // The bisection accepts points up to this far off the surface, along the shell's direction:
      // 2^-rank of the chord's length, or minDelta if that is more.
      double chord = 0.0;
      for (const Triangle& tri : scene.triangles) {
        chord = std::max(chord, 2.0 * static_cast<double>(tri.Domain.w));
      }
      const double bound = std::max(chord * std::ldexp(1.0, -static_cast<int>(rank)), 1e-4) + 1e-6;
      double worst = 0.0;
      for (uint32_t y = 0; y < 120; ++y) {
        for (uint32_t x = 0; x < 160; ++x) {
          const PixelAovs& aov = frame.aovs[y * 160 + x];
          if (aov.triangle == NO_TRIANGLE) continue;
          const PixelRay ray = pixel_ray(params, x, y);
          const dvec3 p =
              ray.eye + ray.direction * static_cast<double>(aov.normal_z.w) + scene.origin;
          worst = std::max(worst, std::abs(glm::length(p) - 1.0));
        }
      }
      EXPECT_LE(worst, bound) << name << " rank " << rank;
      EXPECT_GT(worst, 0.0) << name;
    }
  }
}

TEST_F(Trace, BisectionDropsPixelsAtRank10AndNoneAtRank20) {
  // Rings of holes, a fifth of the sphere's pixels, as the thesis has them: evidence that the port
  // is faithful.
  const Mesh mesh = test::load_asset("sphere-20");
  for (const uint surface : {SURFACE_PHONG, SURFACE_SPHERE}) {
    const BakedScene scene = bake(mesh, {surface, 0.65, SHELL_HEIGHT});
    const auto hits = [&](uint32_t rank) {
      return static_cast<double>(
          test::trace(scene, test::framed(mesh, scene, 400, 300, rank)).hits());
    };
    const double whole = hits(30);
    EXPECT_GT(hits(10) / whole, 0.70);
    EXPECT_LT(hits(10) / whole, 0.85);
    EXPECT_GE(hits(20) / whole, 0.9999);
    EXPECT_EQ(hits(1), 0.0);
  }
}

TEST_F(Trace, EveryCornerOfTheImageIsWhereItBelongs) {
  // Four triangles, one in each corner of the view, distinguished by their indices: the image must
  // be neither mirrored nor upside down.
  Mesh mesh;
  mesh.normals = {{0, 0, 1}};
  const auto add = [&](double x, double y) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{x, y, 0}, {x + 0.5, y, 0}, {x, y + 0.5, 0}});
    mesh.triangles.push_back({{first, first + 1, first + 2}, {0, 0, 0}});
  };
  add(-1.0, 0.5);   // 0: top left
  add(0.5, 0.5);    // 1: top right
  add(-1.0, -1.0);  // 2: bottom left
  add(0.5, -1.0);   // 3: bottom right
  const BakedScene scene = bake(mesh, {SURFACE_FLAT, 0.0});
  TraceSettings settings;
  settings.camera = {{0, 0, 2.4}, {0, 0, 0}, {0, 1, 0}, 45.0};  // sees 0.994 of each side
  settings.width = 65;
  settings.height = 65;
  const Frame frame = test::trace(scene, settings);
  const auto at = [&](uint32_t column, uint32_t row) {
    return frame.aovs[row * 65 + column].triangle;
  };
  EXPECT_EQ(at(4, 12), 0U);
  EXPECT_EQ(at(52, 12), 1U);
  EXPECT_EQ(at(4, 60), 2U);
  EXPECT_EQ(at(52, 60), 3U);
  EXPECT_EQ(at(32, 32), NO_TRIANGLE);
  // Within a triangle U grows to the right and V upward.
  const auto uv = [&](uint32_t column, uint32_t row) {
    const PixelAovs& aov = frame.aovs[row * 65 + column];
    return glm::vec2(aov.geometric_u.w, aov.v);
  };
  EXPECT_GT(uv(8, 60).x, uv(4, 60).x);
  EXPECT_GT(uv(4, 56).y, uv(4, 60).y);
}

TEST_F(Trace, MissesHaveTheSkyAndNothingElse) {
  const Mesh mesh = test::load_asset("sphere-20");
  const BakedScene scene = bake(mesh, {SURFACE_PHONG, 0.65, SHELL_HEIGHT});
  TraceSettings settings = test::framed(mesh, scene, 9, 7, 10);
  settings.camera.target = settings.camera.eye * 2.0;  // away from the model
  const TraceParams params = make_params(scene, settings);
  const Frame frame = test::trace(scene, settings);
  EXPECT_EQ(frame.hits(), 0U);
  for (uint32_t i = 0; i < 63; ++i) {
    const double up = std::abs(pixel_ray(params, i % 9, i / 9).direction.y);
    const dvec3 sky = glm::mix(dvec3(1.0, 0.7, 0.5), dvec3(0.8, 0.9, 1.0), std::sqrt(up));
    EXPECT_LT(glm::distance(dvec3(frame.colors[i]), sky), 1e-5);
    EXPECT_EQ(frame.colors[i].w, 0.0F);
    EXPECT_EQ(frame.aovs[i].triangle, NO_TRIANGLE);
    EXPECT_EQ(frame.aovs[i].normal_z, vec4(0.0F));
    EXPECT_EQ(frame.aovs[i].geometric_u, vec4(0.0F));
    EXPECT_EQ(frame.aovs[i].v, 0.0F);
  }
}

TEST_F(Trace, NormalsAreUnitAndFaceTheEye) {
  const Mesh mesh = test::load_asset("torus");
  for (const uint surface : {SURFACE_FLAT, SURFACE_PHONG, SURFACE_SPHERE}) {
    const BakedScene scene = bake(mesh, {surface, 0.65, SHELL_HEIGHT});
    const TraceSettings settings = test::framed(mesh, scene, 80, 60, 20);
    const TraceParams params = make_params(scene, settings);
    const Frame frame = test::trace(scene, settings);
    EXPECT_GT(frame.hits(), 500U);
    for (uint32_t i = 0; i < 80 * 60; ++i) {
      const PixelAovs& aov = frame.aovs[i];
      if (aov.triangle == NO_TRIANGLE) continue;
      const dvec3 shading(aov.normal_z);
      const dvec3 geometric(aov.geometric_u);
      ASSERT_NEAR(glm::length(shading), 1.0, 1e-6);
      ASSERT_NEAR(glm::length(geometric), 1.0, 1e-6);
      // Only front faces are hit. The two normals differ by as much as the model's 256 triangles
      // turn.
      ASSERT_GT(glm::dot(shading, geometric), 0.85);
      if (surface != SURFACE_FLAT) {
        ASSERT_LE(glm::dot(shading, pixel_ray(params, i % 80, i / 80).direction), 1e-3);
      }
    }
  }
}

TEST_F(Trace, FramesDoNotDependOnTheirTiling) {
  const Mesh mesh = test::load_asset("sphere-80");
  const BakedScene scene = bake(mesh, {SURFACE_PHONG, 0.65, SHELL_HEIGHT});
  const TraceSettings settings = test::framed(mesh, scene, 203, 117, 12);
  const TraceParams params = make_params(scene, settings);
  VulkanTracer tracer(test::validated_device(), scene, 203, 117, {SOLVER_BISECT, true});
  Frame first;
  Frame second;
  int submits = 0;
  tracer.render(params, first, [&](double) { return ++submits > 0; });
  EXPECT_GT(submits, 1) << "the first frame is rendered in small submits";
  // Now the tracer knows the cost of a workgroup and divides the image into other submits.
  tracer.render(params, second);
  EXPECT_EQ(first.colors, second.colors);
  for (std::size_t i = 0; i < first.aovs.size(); ++i) {
    ASSERT_EQ(first.aovs[i].triangle, second.aovs[i].triangle);
    ASSERT_EQ(first.aovs[i].normal_z, second.aovs[i].normal_z);
  }
}

TEST_F(Trace, PixelsOfAnySizeOfImageAreThoseOfTheWholeImage) {
  // One pixel, one row, one column, and sizes that are no multiples of a workgroup's.
  const Mesh mesh = test::load_asset("sphere-20");
  const BakedScene scene = bake(mesh, {SURFACE_FLAT, 0.0});
  for (const auto& [width, height] :
       {std::pair{1U, 1U}, {1U, 37U}, {41U, 1U}, {13U, 17U}, {8U, 8U}}) {
    TraceSettings settings = test::framed(mesh, scene, width, height, 10);
    const Frame frame = test::trace(scene, settings);
    ASSERT_EQ(frame.colors.size(), std::size_t{width} * height);
    // The camera looks at the model's middle.
    EXPECT_EQ(frame.colors[(height / 2) * width + width / 2].w, 1.0F) << width << "x" << height;
    for (const vec4& color : frame.colors) EXPECT_GT(color.x, 0.1F) << "a pixel was not written";
  }
}

TEST_F(Trace, AnImageLargerThanABufferComesInBands) {
  const Mesh mesh = test::load_asset("sphere-20");
  const BakedScene scene = bake(mesh, {SURFACE_PHONG, 0.65, SHELL_HEIGHT});
  const TraceSettings settings = test::framed(mesh, scene, 100, 61, 16);
  // Buffers that hold 16 of the 61 rows: four bands, the last of 13.
  VulkanTracer tracer(test::validated_device(), scene, 100, 61, {SOLVER_BISECT, true},
                      std::size_t{100} * 20 * sizeof(PixelAovs));
  Frame banded;
  tracer.render(make_params(scene, settings), banded);
  const Frame whole = test::trace(scene, settings);
  EXPECT_EQ(banded.colors, whole.colors);
  for (std::size_t i = 0; i < whole.aovs.size(); ++i) {
    ASSERT_EQ(banded.aovs[i].triangle, whole.aovs[i].triangle);
    ASSERT_EQ(banded.aovs[i].normal_z, whole.aovs[i].normal_z);
  }
}

TEST_F(Trace, StopsBetweenTwoSubmits) {
  const Mesh mesh = test::load_asset("sphere-20");
  const BakedScene scene = bake(mesh, {SURFACE_PHONG, 0.65, SHELL_HEIGHT});
  const TraceSettings settings = test::framed(mesh, scene, 400, 300, 10);
  VulkanTracer tracer(test::validated_device(), scene, 400, 300, {SOLVER_BISECT, false});
  Frame frame;
  int submits = 0;
  EXPECT_FALSE(
      tracer.render(make_params(scene, settings), frame, [&](double) { return ++submits < 2; }));
  EXPECT_EQ(submits, 2);
  // An exception of the caller's function passes through.
  EXPECT_THROW(tracer.render(make_params(scene, settings), frame,
                             [](double) -> bool { throw std::runtime_error("stop"); }),
               std::runtime_error);
  // The tracer renders the next frame as if nothing had happened.
  tracer.render(make_params(scene, settings), frame);
  EXPECT_GT(frame.hits(), 10000U);
}

TEST_F(Trace, ColorDoesNotDependOnAovs) {
  const Mesh mesh = test::load_asset("relief");
  const BakedScene scene = bake(mesh, {SURFACE_PHONG, 0.65, SHELL_HEIGHT});
  const TraceSettings settings = test::framed(mesh, scene, 100, 75, 16);
  VulkanTracer tracer(test::validated_device(), scene, 100, 75, {SOLVER_BISECT, false});
  Frame color_only;
  tracer.render(make_params(scene, settings), color_only);
  EXPECT_TRUE(color_only.aovs.empty());
  EXPECT_EQ(color_only.colors, test::trace(scene, settings).colors);
}

TEST_F(Trace, FarFromTheOriginTheFrameIsTheSame) {
  Mesh mesh = test::load_asset("sphere-20");
  const BakedScene near = bake(mesh, {SURFACE_SPHERE, 0.0, SHELL_HEIGHT});
  const Frame expected = test::trace(near, test::framed(mesh, near, 160, 120, 24));
  for (dvec3& p : mesh.positions) p += dvec3(1e6, -2e6, 3e6);
  const BakedScene far = bake(mesh, {SURFACE_SPHERE, 0.0, SHELL_HEIGHT});
  const test::FrameDifference d =
      test::difference(expected, test::trace(far, test::framed(mesh, far, 160, 120, 24)));
  // Rays and vertices are rounded differently: pixels at an edge may hit another triangle.
  EXPECT_LE(d.hit_mismatches, 3U);
  EXPECT_LE(d.patch_mismatches, 3U);
  // Where both hit, the bisection's last step may differ: by minDelta, 1e-4, along a ray whose
  // angle to the surface has a sine of 1/4.
  EXPECT_LE(d.depth, 4e-4);
}

TEST_F(Trace, RefusesAnImageThatNoBufferHolds) {
  const BakedScene scene = bake(test::load_asset("cube"), {SURFACE_PHONG, 0.65, SHELL_HEIGHT});
  constexpr std::size_t limit = 1000 * sizeof(PixelAovs);
  EXPECT_NO_THROW(
      VulkanTracer(test::validated_device(), scene, 125, 8, {SOLVER_BISECT, true}, limit));
  EXPECT_THROW(VulkanTracer(test::validated_device(), scene, 126, 8, {SOLVER_BISECT, true}, limit),
               gpu::Error);
}

TEST_F(Trace, RefusesAModelThatNoBufferHolds) {
  const BakedScene scene = bake(test::load_asset("cube"), {SURFACE_PHONG, 0.65, SHELL_HEIGHT});
  try {
    const VulkanTracer tracer(test::validated_device(), scene, 8, 1, {SOLVER_BISECT, false},
                              11 * sizeof(Triangle));
    FAIL() << "accepted";
  } catch (const gpu::Error& error) {
    EXPECT_NE(std::string(error.what()).find("hold 11 triangles; the model has 12"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(Trace, WorksAtBothEndsOfTheRangeOfSizes) {
  // The bisection's tolerances are absolute, so at such sizes it finds little of a curved surface.
  // What can be tested is that single precision neither overflows nor underflows.
  const Mesh unit = test::load_asset("sphere-20");
  const BakedScene reference = bake(unit, {SURFACE_FLAT, 0.0});
  const Frame expected = test::trace(reference, test::framed(unit, reference, 80, 60, 10));
  for (const double scale : {4e-9, 2e8}) {
    Mesh mesh = unit;
    for (dvec3& p : mesh.positions) p *= scale;
    const BakedScene scene = bake(mesh, {SURFACE_FLAT, 0.0});
    const Frame frame = test::trace(scene, test::framed(mesh, scene, 80, 60, 10));
    // The scale is no power of two, so vertices are rounded differently: a pixel at the outline may
    // change.
    EXPECT_NEAR(static_cast<double>(frame.hits()), static_cast<double>(expected.hits()), 2.0)
        << scale;
  }
}

TEST_F(Trace, CountsTheBytesThatRaysRead) {
  const Mesh mesh = test::load_asset("sphere-320");
  const auto bytes_of = [&](const BakedScene& scene, uint solver, Accel accel) {
    TraceSettings settings = test::framed(mesh, scene, 800, 600, 10);
    settings.solver = solver;
    const TraceParams params = make_params(scene, settings);
    VulkanTracer tracer(test::validated_device(), scene, 800, 600,
                        {.solver = solver, .aovs = true, .counts = true, .accel = accel});
    Frame frame;
    // The count of a frame that is stopped is not added to that of the next one.
    EXPECT_FALSE(tracer.render(params, frame, [](double) { return false; }));
    tracer.render(params, frame);
    return frame.bytes_read;
  };
  constexpr uint64_t kPixels = uint64_t{800} * 600;
  // Every ray reads the three corners of every triangle: the sum needs more than 32 bits.
  const BakedScene flat = bake(mesh, {SURFACE_FLAT, 0.0});
  EXPECT_EQ(bytes_of(flat, SOLVER_BISECT, Accel::list), kPixels * 320 * 3 * sizeof(vec4));
  BakedScene curved = bake_with_subpatches(mesh, {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  curved.bvh = build_bvh(curved);
  const uint64_t list = bytes_of(curved, SOLVER_ROBUST, Accel::list);
  // Every ray reads at least the ball of every patch, and some rays whole subpatches.
  EXPECT_GT(list, kPixels * curved.triangles.size() * sizeof(vec4));
  for (const Accel accel : {Accel::tiles, Accel::bvh}) {
    const uint64_t bytes = bytes_of(curved, SOLVER_ROBUST, accel);
    EXPECT_GT(bytes, kPixels * sizeof(vec4)) << accel_name(accel);
    // A quarter of the image has subpatches, a few per pixel. Where a subgroup is too small for
    // packets, a ray reads all eight children of a node itself, not one for the whole packet.
    const bool alone = accel == Accel::bvh && test::validated_device().subgroup_size() < 8;
    EXPECT_LT(bytes, alone ? list : list / 4) << accel_name(accel);
  }
}

TEST_F(Trace, AFaceInAPlaneOfTheGridIsNotAllLine) {
  const Mesh mesh = test::one_triangle({dvec3(-1, -1, 0), dvec3(1, -1, 0), dvec3(0, 1, 0)},
                                       {dvec3(0, 0, 1), dvec3(0, 0, 1), dvec3(0, 0, 1)});
  const BakedScene scene = bake(mesh, {SURFACE_FLAT, 0.0});
  TraceSettings settings;
  settings.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 45.0};
  settings.width = 64;
  settings.height = 64;
  settings.shading = SHADING_GRID;
  settings.color = standard_color(SHADING_GRID);
  const Frame frame = test::trace(scene, settings);
  float darkest = 1.0F;
  float lightest = 0.0F;
  for (const vec4& color : frame.colors) {
    if (color.w == 0.0F) continue;
    darkest = std::min(darkest, color.x);
    lightest = std::max(lightest, color.x);
  }
  EXPECT_GT(lightest - darkest, 0.1F);
}

}  // namespace
}  // namespace trisect
