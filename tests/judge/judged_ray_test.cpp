// The judge must find what is wrong: right hits with mistakes put into them.
#include "app/judge/judged_ray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "app/bake/subpatch_bounds.h"
#include "app/dispatch/cpu_tracer.h"
#include "app/dispatch/trace_settings.h"
#include "app/judge/cast_files.h"
#include "app/judge/hard_rays.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

constexpr std::size_t kEach = 24;  // rays of a kind

class Judged : public testing::TestWithParam<uint> {
 protected:
  Judged() {
    for (const char* kind : {"random", "edge", "grazing"}) {
      for (const FileRay& ray : hard_rays(scene_, kind, kEach, 1)) rays_.push_back(ray);
    }
    hits_ = *cast_by_oracle(scene_, rays_, {});
    right_ = sum_of(*judged_rays(scene_, rays_, hits_, {}));
  }

  // What comes of it if hit i, which is right and decidable, becomes another one.
  template <typename Change>
  Judgement with(std::size_t i, Change&& change) {
    std::vector<FileHit> hits = hits_;
    change(hits[i]);
    return sum_of(*judged_rays(scene_, rays_, hits, {}));
  }

  BakedScene scene_ =
      bake_about(test::load_asset("sphere-80"), {GetParam(), 0.65, SHELL_NORMAL}, dvec3(0.0));
  std::vector<FileRay> rays_;
  std::vector<FileHit> hits_;
  Judgement right_;
};

TEST_P(Judged, TheOraclesOwnHitsAreRight) {
  EXPECT_EQ(right_.rays, 3 * kEach);
  EXPECT_EQ(right_.wrong(), 0U);
  EXPECT_EQ(right_.hits + right_.misses + right_.undecidable, 3 * kEach);
  EXPECT_GT(right_.misses, 0U);
  EXPECT_EQ(right_.ulp.max, 0.0);
  EXPECT_EQ(right_.weight.max, 0.0);
}

TEST_P(Judged, OneOfEachMistakeIsFoundAndCounted) {
  // Ray 0 is a random one, whose hit is inside of a triangle or at least decided.
  ASSERT_NE(hits_[0].triangle, NO_TRIANGLE);
  Judgement sum = with(0, [](FileHit& hit) { hit = {}; });
  EXPECT_EQ(sum.missed, 1U);
  EXPECT_EQ(sum.wrong(), 1U);
  EXPECT_EQ(sum.hits, right_.hits - 1);
  // The nearest hit passed by, for the one on the other side.
  OracleRay beyond = to_oracle_ray(scene_, rays_[0]);
  beyond.t_min = hits_[0].t + 1e-3;
  const OracleAnswer second = Oracle(scene_).first(beyond, 0.0);
  ASSERT_TRUE(second.hit);
  sum = with(0, [&](FileHit& hit) {
    hit.t = second.root.t;
    hit.triangle = second.root.triangle;
  });
  EXPECT_EQ(sum.wrong_patch, 1U);
  EXPECT_EQ(sum.wrong(), 1U);
  // The right triangle, too far.
  sum = with(0, [](FileHit& hit) { hit.t += 0.1; });
  EXPECT_EQ(sum.wrong_root, 1U);
  EXPECT_EQ(sum.wrong(), 1U);
  // Another triangle at the right place.
  sum = with(0, [](FileHit& hit) { hit.triangle = (hit.triangle + 40) % 80; });
  EXPECT_EQ(sum.wrong(), 0U);
  EXPECT_EQ(sum.hits, right_.hits);
  sum = with(0, [](FileHit& hit) { hit.t = std::nan(""); });
  EXPECT_EQ(sum.nans, 1U);
  sum = with(0, [](FileHit& hit) { hit.t = std::numeric_limits<double>::infinity(); });
  EXPECT_EQ(sum.nans, 1U);
  // A hit where there is none: of the last ray that misses.
  const std::vector<JudgedRay> judged = *judged_rays(scene_, rays_, hits_, {});
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    if (judged[i].verdict != RayVerdict::both_miss) continue;
    sum = with(i, [](FileHit& hit) { hit = {4.0, 0.2, 0.2, 7}; });
    EXPECT_EQ(sum.invented, 1U);
    EXPECT_EQ(sum.wrong(), 1U);
    break;
  }
}

// An error that is none of these is measured.
TEST_P(Judged, ErrorsAreMeasured) {
  Judgement sum = with(0, [](FileHit& hit) { hit.t += 1e-5; });
  EXPECT_EQ(sum.wrong(), 0U);
  EXPECT_NEAR(sum.length.max, 1e-5, 1e-12);
  // A float between 2 and 4 has steps of 2^-22, between 4 and 8 of 2^-21.
  const double step = std::ldexp(1.0, hits_[0].t < 4.0 ? -22 : -21);
  EXPECT_NEAR(sum.ulp.max, 1e-5 / step, 0.01);
  EXPECT_LE(sum.across.max, 1e-5 / scene_.extent);
  EXPECT_GT(sum.across.max, 1e-7);
  sum = with(0, [](FileHit& hit) { hit.u -= 0.01; });
  EXPECT_NEAR(sum.weight.max, 0.01, 1e-9);
  // Weights that are not told are not judged.
  sum = with(0, [](FileHit& hit) { hit.u = hit.v = std::nan(""); });
  EXPECT_EQ(sum.wrong(), 0U);
  EXPECT_EQ(sum.weight.max, 0.0);
}

TEST_P(Judged, ATriangleThatIsNotToldIsJudgedByItsDistance) {
  Judgement sum = with(0, [](FileHit& hit) { hit.triangle = kSomeTriangle; });
  EXPECT_EQ(sum.wrong(), 0U);
  EXPECT_EQ(sum.hits, right_.hits);
  sum = with(0, [](FileHit& hit) {
    hit.triangle = kSomeTriangle;
    hit.t += 0.1;
  });
  EXPECT_EQ(sum.wrong_root, 1U);
}

// Rays through edges that come out behind the model have leaked.
TEST_P(Judged, LeaksAreToldByTheirPlace) {
  std::vector<FileHit> hits = hits_;
  const std::vector<JudgedRay> judged = *judged_rays(scene_, rays_, hits, {});
  std::size_t at_edges = 0;
  for (std::size_t i = kEach; i < 2 * kEach; ++i) {
    hits[i] = {};
    at_edges += judged[i].verdict == RayVerdict::hit && judged[i].place == RootPlace::edge ? 1 : 0;
  }
  // The others pass the outline.
  EXPECT_GT(at_edges, kEach / 3);
  const Judgement sum = sum_of(*judged_rays(scene_, rays_, hits, {}));
  EXPECT_EQ(sum.at_edge, at_edges);
  EXPECT_EQ(sum.at_vertex, 0U);
}

// Far away single precision does not tell neighbours apart.
TEST_P(Judged, HitsWithinAUnitOfTheLastPlaceAreATie) {
  ASSERT_NE(hits_[0].triangle, NO_TRIANGLE);
  constexpr double away = 1e4;
  rays_[0].origin -= rays_[0].direction * away;
  const double ulp = std::ldexp(1.0, 13 - 23);  // between 8192 and 16384
  const double t = hits_[0].t + away;
  const auto judged = [&](double off) {
    return with(0, [&](FileHit& hit) {
      hit.t = t + off * ulp;
      hit.triangle = (hit.triangle + 1) % 80;
    });
  };
  EXPECT_EQ(judged(0.9).wrong(), 0U);
  EXPECT_EQ(judged(0.9).hits, right_.hits);
  EXPECT_EQ(judged(-3.0).wrong_patch, 1U);
}

// t counts in the direction's length.
TEST_P(Judged, DirectionsMayHaveAnyLength) {
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const double length = 0.01 * static_cast<double>(i + 1);
    rays_[i].direction *= length;
    hits_[i].t /= length;
  }
  const Judgement sum = sum_of(*judged_rays(scene_, rays_, hits_, {}));
  EXPECT_EQ(sum.wrong(), 0U);
  EXPECT_EQ(sum.hits, right_.hits);
  // The roundings of double precision, of lengths of up to 8.
  EXPECT_LT(sum.length.max, 1e-11);
}

TEST_P(Judged, RaysEndWhereTheySay) {
  ASSERT_NE(hits_[0].triangle, NO_TRIANGLE);
  rays_[0].t_max = hits_[0].t - 1e-3;
  EXPECT_EQ(sum_of(*judged_rays(scene_, rays_, hits_, {})).invented, 1U);
  const FileHit none = (*cast_by_oracle(scene_, rays_, {}))[0];
  EXPECT_EQ(none.triangle, NO_TRIANGLE);
  rays_[0].t_max = std::numeric_limits<double>::infinity();
  rays_[0].t_min = hits_[0].t + 1e-3;
  EXPECT_EQ(sum_of(*judged_rays(scene_, rays_, hits_, {})).wrong(), 1U);
}

// The robust solver, which works about the model's middle, far from the origin of the coordinates.
TEST_P(Judged, TheRobustSolverIsRight) {
  for (const dvec3& away : {dvec3(0.0), dvec3(300.0, -200.0, 100.0)}) {
    Mesh mesh = test::load_asset("sphere-80");
    for (dvec3& p : mesh.positions) p = dvec3(glm::vec3(p + away));
    const SurfaceChoice choice{GetParam(), 0.65, SHELL_NORMAL};
    const BakedScene in_place = bake_about(mesh, choice, dvec3(0.0));
    const BakedScene scene = bake_with_subpatches(mesh, choice);
    TraceSettings settings;
    settings.camera.eye = scene.origin + dvec3(0.0, 0.0, 3.0);
    settings.camera.target = scene.origin;
    const TraceParams params = make_params(scene, settings);
    for (const RayKind& kind : kRayKinds) {
      std::vector<FileRay> rays = hard_rays(in_place, kind.name, kEach, 5);
      for (std::size_t i = 0; i < rays.size(); ++i) rays[i].direction *= i % 2 == 0 ? 1.0 : 4.0;
      for (FileRay& ray : rays) ray.t_min /= glm::length(ray.direction);
      const std::vector<FileHit> hits =
          *cast_file_rays(scene, rays,
                          [&](std::span<const CastRay> casts) {
                            return cast_on_cpu(scene, params, SOLVER_ROBUST, casts);
                          },
                          {});
      const Judgement sum = sum_of(*judged_rays(in_place, rays, hits, {}));
      EXPECT_EQ(sum.wrong(), 0U) << kind.name << away.x;
      EXPECT_GT(sum.hits, kEach / 3) << kind.name << away.x;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, Judged,
                         testing::Values(SURFACE_FLAT, SURFACE_PHONG, SURFACE_SPHERE));

TEST(JudgedRays, NeedAHitForEachRayAndTrianglesThatAreThere) {
  const BakedScene scene = bake_about(test::load_asset("cube"), {SURFACE_FLAT, 0.0}, dvec3(0.0));
  const std::vector<FileRay> rays(2);
  EXPECT_THROW(judged_rays(scene, rays, std::vector<FileHit>(1), {}), std::invalid_argument);
  EXPECT_THROW(judged_rays(scene, rays, std::vector<FileHit>(2, {1.0, 0.0, 0.0, 12}), {}),
               std::out_of_range);
  EXPECT_FALSE(judged_rays(scene, rays, std::vector<FileHit>(2), [](uint32_t) { return false; }));
}

}  // namespace
}  // namespace trisect
