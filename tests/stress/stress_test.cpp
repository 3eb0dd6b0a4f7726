// The robust solver on the catalogue of hard cases, and the judge that tells whether it passes.
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
  for (const RayCase& ray_case : stress_ray_catalogue()) {
    EXPECT_TRUE(names.insert(ray_case.name).second);
  }
  for (const CheckedCase& checked_case : stress_checked_cases()) {
    EXPECT_TRUE(names.insert(checked_case.name).second);
  }
  EXPECT_GE(names.size(), 42U);
}

TEST_F(HardCases, TheRobustSolverPassesThem) {
  const StressBackend backend = vulkan_stress_backend(test::validated_device());
  for (const RayCase& ray_case : stress_ray_catalogue()) {
    for (const uint surface : ray_case.surfaces) {
      const StressRow row = run_robust_row(ray_case, surface, backend);
      EXPECT_EQ(row.verdict, "pass")
          << row.name << " on surface " << surface << ": " << row.outcome.wrong << " wrong, "
          << row.outcome.missed << " missed, " << row.outcome.nans << " NaNs, "
          << row.outcome.undecidable << " undecidable, largest error " << row.error_ulp(1.0)
          << " ulp";
    }
  }
}

// Where normals lie in their face's plane or beyond it the height shell is bound to be right, too.
TEST_F(HardCases, TheRobustSolverPassesReclinedNormalsInBothShells) {
  const StressBackend backend = vulkan_stress_backend(test::validated_device());
  std::size_t rows = 0;
  for (const RayCase& ray_case : stress_reclined_cases()) {
    for (const uint surface : ray_case.surfaces) {
      for (const StressRow& row : run_rows(ray_case, surface, backend)) {
        if (row.solver != SOLVER_ROBUST) continue;
        ++rows;
        EXPECT_EQ(row.verdict, "pass")
            << row.name << " on " << surface_name(surface) << ", " << shell_name(row.shell) << ": "
            << row.outcome.wrong << " wrong, " << row.outcome.missed << " missed, "
            << row.outcome.nans << " NaNs, " << row.outcome.undecidable << " undecidable";
      }
    }
  }
  EXPECT_EQ(rows, 8U * 5U);
}

TEST_F(HardCases, ImagesAndFilesAreAsTheyShould) {
  const StressBackend backend = vulkan_stress_backend(test::validated_device());
  for (const CheckedCase& checked_case : stress_checked_cases()) {
    const StressRow row = run_row(checked_case, backend);
    EXPECT_EQ(row.verdict, "pass") << row.name << ": " << row.outcome.note;
  }
}

// A flat patch with rays of which one misses, and the right hits.
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

TEST(HardJudge, KnowsWhatAnotherPatchOrRootIs) {
  Judged judged;
  judged.hits[0].triangle = 5;
  judged.hits[0].z += 1e-4F;
  judged.hits[1].z += 0.1F;
  judged.hits[2].z += 1e-4F;
  EXPECT_EQ(judged.outcome().wrong, 2U);
  EXPECT_EQ(judged.outcome().errors.size(), 1U);
}

// A row of 100 rays of which the given number is undecidable and all others hit correctly.
StressRow row_with(uint solver, std::size_t undecidable, double most_undecidable) {
  StressRow row;
  row.solver = solver;
  row.most_undecidable = most_undecidable;
  row.outcome.rays = 100;
  row.outcome.undecidable = undecidable;
  row.outcome.errors.assign(100 - undecidable, 1e-8);
  return row;
}

TEST(StressVerdict, ARobustRowFailsIfTooManyRaysAreUndecidable) {
  EXPECT_EQ(verdict_of(row_with(SOLVER_ROBUST, 0, 0.1), false), "pass");
  EXPECT_EQ(verdict_of(row_with(SOLVER_ROBUST, 10, 0.1), false), "pass");
  EXPECT_EQ(verdict_of(row_with(SOLVER_ROBUST, 11, 0.1), false), "FAIL");
  EXPECT_EQ(verdict_of(row_with(SOLVER_ROBUST, 11, 0.11), false), "pass");
  EXPECT_EQ(verdict_of(row_with(SOLVER_ROBUST, 100, 0.99), false), "FAIL");
  EXPECT_EQ(verdict_of(row_with(SOLVER_ROBUST, 10, 0.1), true), "cracks");
  EXPECT_EQ(verdict_of(row_with(SOLVER_ROBUST, 11, 0.1), true), "FAIL");
}

TEST(StressVerdict, ARowThatDecidesNoRayIsNoPass) {
  EXPECT_EQ(verdict_of(row_with(SOLVER_ROBUST, 100, 1.0), false), "undecided");
  EXPECT_EQ(verdict_of(row_with(SOLVER_ROBUST, 100, 1.0), true), "undecided");
  EXPECT_EQ(verdict_of(row_with(SOLVER_ROBUST, 99, 1.0), false), "pass");
  EXPECT_EQ(verdict_of(row_with(SOLVER_BISECT, 100, 0.1), false), "undecided");
  EXPECT_EQ(verdict_of(row_with(SOLVER_BISECT, 99, 0.1), false), "ok");
  StressRow row = row_with(SOLVER_ROBUST, 100, 1.0);
  row.outcome.rays = 101;
  row.outcome.nans = 1;
  EXPECT_EQ(verdict_of(row, false), "FAIL");
  row.solver = SOLVER_BISECT;
  EXPECT_EQ(verdict_of(row, false), "fails");
  // A row without rays is no pass either.
  row.outcome = {};
  EXPECT_EQ(verdict_of(row, false), "undecided");
  row.solver = SOLVER_ROBUST;
  EXPECT_EQ(verdict_of(row, false), "undecided");
}

TEST(StressVerdict, UndecidedRowsAreCountedApart) {
  std::vector<StressRow> rows(7);
  rows[0].verdict = "pass";
  rows[1].verdict = "undecided";
  rows[2].verdict = "FAIL";
  rows[3].verdict = "cracks";
  // The following rows are not binding.
  rows[4].verdict = "FAIL";
  rows[4].shell = SHELL_HEIGHT;
  rows[5].verdict = "fails";
  rows[5].solver = SOLVER_BISECT;
  rows[6].verdict = "undecided";
  rows[6].solver = SOLVER_BISECT;
  const BindingRows binding = count_binding(rows);
  EXPECT_EQ(binding.all, 4U);
  EXPECT_EQ(binding.passed, 1U);
  EXPECT_EQ(binding.undecided, 1U);
  EXPECT_EQ(binding.failed(), 2U);
}

// Rays along the edge of a flat triangle, none of which the oracle decides.
TEST(StressVerdict, ACaseMustSayThatItIsUndecidable) {
  RayCase ray_case;
  ray_case.name = "in-the-plane";
  ray_case.mesh = [] {
    return stress::plain_patch({dvec3(0, 0, 1), dvec3(0, 0, 1), dvec3(0, 0, 1)});
  };
  ray_case.rays = [](const BakedScene& scene, std::mt19937_64& /*random*/) {
    return std::vector<CastRay>(
        3, stress::ray_exactly_through(scene, dvec3(scene.triangles[0].Position[0]), {1, 0, 0}));
  };
  const StressBackend backend = cpu_stress_backend();
  StressRow row = run_robust_row(ray_case, SURFACE_FLAT, backend);
  EXPECT_EQ(row.outcome.undecidable, 3U);
  EXPECT_EQ(row.verdict, "FAIL");
  ray_case.most_undecidable = 1.0;
  row = run_robust_row(ray_case, SURFACE_FLAT, backend);
  EXPECT_EQ(row.most_undecidable, 1.0);
  EXPECT_EQ(row.verdict, "undecided");
}

TEST(HardJudge, AnImageOrRowOfNoRaysHasNoErrors) {
  StressRow row;
  EXPECT_EQ(row.error_ulp(0.99), 0.0);
  EXPECT_EQ(row.evaluations_per_ray(), 0.0);
}

}  // namespace
}  // namespace trisect
