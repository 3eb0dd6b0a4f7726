// The catalogue of hard cases, and its judge.
#include "app/stress/stress_cases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "app/bake/subpatch_bounds.h"
#include "app/dispatch/trace_settings.h"
#include "app/stress/stress_backend.h"
#include "app/stress/stress_judge.h"
#include "app/stress/stress_scenes.h"
#include "tests/support/gpu.h"

namespace trisect {
namespace {

using glm::dvec3;

class HardCases : public test::GpuTest {};

TEST_F(HardCases, NamesAreDistinct) {
  std::set<std::string> names;
  for (const RayCase& stress : stress_ray_catalogue())
    EXPECT_TRUE(names.insert(stress.name).second);
  for (const CheckedCase& stress : stress_checked_cases())
    EXPECT_TRUE(names.insert(stress.name).second);
  EXPECT_GE(names.size(), 42U);
}

TEST_F(HardCases, TheRobustSolverPassesThem) {
  const StressBackend backend = vulkan_stress_backend(test::validated_device());
  for (const RayCase& stress : stress_ray_catalogue()) {
    for (const uint surface : stress.surfaces) {
      const StressRow row = run_robust_row(stress, surface, backend);
      EXPECT_EQ(row.verdict, "pass")
          << row.name << " on surface " << surface << ": " << row.outcome.wrong << " wrong, "
          << row.outcome.missed << " missed, " << row.outcome.nans << " NaNs, largest error "
          << row.error_ulp(1.0) << " ulp";
    }
  }
}

TEST_F(HardCases, ImagesAndFilesAreAsTheyShould) {
  const StressBackend backend = vulkan_stress_backend(test::validated_device());
  for (const CheckedCase& stress : stress_checked_cases()) {
    const StressRow row = run_row(stress, backend);
    EXPECT_EQ(row.verdict, "pass") << row.name << ": " << row.outcome.note;
  }
}

// A flat patch with rays of which some miss, and hits that are as they should be.
struct Judged {
  BakedScene scene;
  std::vector<CastRay> rays;
  std::vector<OracleAnswer> answers;
  std::vector<CastHit> hits;

  Judged()
      : scene(bake_with_subpatches(
            stress::plain_patch({dvec3(0, 0, 1), dvec3(0, 0, 1), dvec3(0, 0, 1)}), {})) {
    for (const double x : {-0.2, 0.1, 0.2, 3.0}) {
      rays.push_back(stress::ray_exactly_through(scene, {x, -0.2, 0.0}, {0.1, 0.2, -1.0}));
    }
    answers = oracle_answers(Oracle(scene), rays, scene.radius);
    TraceSettings settings;
    settings.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 45.0};
    hits = cpu_stress_backend().cast(scene, make_params(scene, settings), SOLVER_ROBUST, rays);
  }
  [[nodiscard]] CheckedOutcome outcome() const { return judge(rays, hits, answers, scene.radius); }
};

TEST(HardJudge, PassesHitsAsTheyShouldBe) {
  const CheckedOutcome outcome = Judged().outcome();
  EXPECT_TRUE(passes(outcome));
  EXPECT_EQ(outcome.rays, 4U);
  EXPECT_EQ(outcome.errors.size(), 3U);
  EXPECT_EQ(outcome.undecidable, 0U);
}

TEST(HardJudge, SeesAHitThatIsNone) {
  Judged judged;
  judged.hits[3].triangle = 0;
  EXPECT_EQ(judged.outcome().wrong, 1U);
  EXPECT_FALSE(passes(judged.outcome()));
}

TEST(HardJudge, SeesAHitThatIsLost) {
  Judged judged;
  judged.hits[1] = {0, 0, 0, NO_TRIANGLE, 0, 0, 0, 0};
  EXPECT_EQ(judged.outcome().missed, 1U);
  EXPECT_FALSE(passes(judged.outcome()));
}

TEST(HardJudge, SeesANan) {
  Judged judged;
  judged.hits[1].z = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(judged.outcome().nans, 1U);
  EXPECT_FALSE(passes(judged.outcome()));
}

TEST(HardJudge, SeesAnErrorOfDepth) {
  Judged judged;
  judged.hits[1].z += 4e-6F;
  EXPECT_EQ(judged.outcome().wrong, 0U);
  EXPECT_FALSE(passes(judged.outcome()));
  judged.hits[1].z += 0.1F;
  EXPECT_EQ(judged.outcome().wrong, 1U);
}

TEST(HardJudge, NeighboursTieAndOtherTrianglesDoNot) {
  Judged judged;
  judged.hits[1].triangle = 5;
  EXPECT_TRUE(passes(judged.outcome()));
  judged.hits[1].z += 1e-4F;
  EXPECT_EQ(judged.outcome().wrong, 1U);
}

TEST(HardJudge, CountsWhatCannotBeDecided) {
  Judged judged;
  judged.answers[1].decidable = false;
  judged.hits[1] = {0, 0, 0, NO_TRIANGLE, 0, 0, 0, 0};
  EXPECT_EQ(judged.outcome().undecidable, 1U);
  EXPECT_TRUE(passes(judged.outcome()));
}

TEST(HardJudge, AnImageOrRowOfNoRaysHasNoErrors) {
  StressRow row;
  EXPECT_EQ(row.error_ulp(0.99), 0.0);
  EXPECT_EQ(row.evaluations_per_ray(), 0.0);
}

}  // namespace
}  // namespace trisect
