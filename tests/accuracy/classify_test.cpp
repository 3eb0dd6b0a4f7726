// The rules by which hits are judged: each verdict, and both sides of each border.
#include "app/accuracy/classify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trisect {
namespace {

using glm::dvec3;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr float kNanSingle = std::numeric_limits<float>::quiet_NaN();
constexpr double kRadius = 4.0;
const dvec3 kAlong(0.0, 0.0, -1.0);

// A ray along -z that the oracle sees hit triangle 7 at t = 5, where n.d is -slant.
OracleAnswer oracle_hit(double slant = 1.0) {
  OracleAnswer answer;
  answer.hit = true;
  answer.root = {5.0, 7, dvec3(1.0 / 3.0), dvec3(std::sqrt(1.0 - slant * slant), 0.0, slant)};
  return answer;
}

ClassifiedRay classify_found(const FoundHit& found, const OracleAnswer& answer) {
  return classify(found, answer, kAlong, kRadius);
}

// The verdict of a hit on `triangle` whose depth is wrong by this fraction of the radius.
RayVerdict verdict_at(uint triangle, double depth_error, double slant) {
  return classify_found({triangle, 5.0 + depth_error * kRadius}, oracle_hit(slant)).verdict;
}

TEST(Classify, TheSameHit) {
  const ClassifiedRay ray = classify_found({7, 5.0}, oracle_hit());
  EXPECT_EQ(ray.verdict, RayVerdict::hit);
  EXPECT_EQ(ray.off_surface, 0.0);
  EXPECT_EQ(ray.depth_error, 0.0);
}

TEST(Classify, ADistanceIsAcrossTheSurfaceAndOverTheRadius) {
  for (const double side : {-1.0, 1.0}) {
    const ClassifiedRay ray = classify_found({7, 5.0 + side * 0.0625}, oracle_hit(0.5));
    EXPECT_EQ(ray.verdict, RayVerdict::hit);
    EXPECT_EQ(ray.depth_error, 0.0625);
    EXPECT_EQ(ray.off_surface, 0.0625 * 0.5 / kRadius);
  }
}

TEST(Classify, Misses) {
  const OracleAnswer miss;
  EXPECT_EQ(classify_found({}, miss).verdict, RayVerdict::both_miss);
  EXPECT_EQ(classify_found({7, 5.0}, miss).verdict, RayVerdict::wrong_hit);
  EXPECT_EQ(classify_found({}, oracle_hit()).verdict, RayVerdict::missed);
}

TEST(Classify, NeighboursTieWithinAMillionthOfTheRadius) {
  for (const double slant : {1.0, 0.3, 2e-3}) {
    EXPECT_EQ(verdict_at(8, 0.99 * 1e-6 / slant, slant), RayVerdict::hit) << slant;
    EXPECT_EQ(verdict_at(8, -0.99 * 1e-6 / slant, slant), RayVerdict::hit) << slant;
    EXPECT_EQ(verdict_at(8, 1.01 * 1e-6 / slant, slant), RayVerdict::wrong_patch) << slant;
    EXPECT_EQ(verdict_at(8, -1.01 * 1e-6 / slant, slant), RayVerdict::wrong_patch) << slant;
    // The same triangle needs no tie.
    EXPECT_EQ(verdict_at(7, 1.01 * 1e-6 / slant, slant), RayVerdict::hit) << slant;
  }
}

TEST(Classify, AHundredthOfTheRadiusIsAnotherRoot) {
  for (const double slant : {1.0, 0.3}) {
    EXPECT_EQ(verdict_at(7, 0.99 * 1e-2 / slant, slant), RayVerdict::hit) << slant;
    EXPECT_EQ(verdict_at(7, 1.01 * 1e-2 / slant, slant), RayVerdict::wrong_root) << slant;
    EXPECT_EQ(verdict_at(7, -1.01 * 1e-2 / slant, slant), RayVerdict::wrong_root) << slant;
    EXPECT_EQ(verdict_at(8, 1.01 * 1e-2 / slant, slant), RayVerdict::wrong_patch) << slant;
  }
}

// Below a slant of 1e-3 the rules take it for 1e-3; the distance that is returned does not.
TEST(Classify, AGrazingRayIsNoExcuse) {
  for (const double slant : {1e-3, 1e-5, 0.0}) {
    EXPECT_EQ(verdict_at(8, 0.99 * 1e-6 / 1e-3, slant), RayVerdict::hit) << slant;
    EXPECT_EQ(verdict_at(8, 1.01 * 1e-6 / 1e-3, slant), RayVerdict::wrong_patch) << slant;
    EXPECT_EQ(verdict_at(7, 0.99 * 1e-2 / 1e-3, slant), RayVerdict::hit) << slant;
    EXPECT_EQ(verdict_at(7, 1.01 * 1e-2 / 1e-3, slant), RayVerdict::wrong_root) << slant;
  }
  EXPECT_EQ(classify_found({8, 5.5}, oracle_hit(0.0)).off_surface, 0.0);
  EXPECT_EQ(classify_found({7, 5.5}, oracle_hit(0.25)).off_surface, 0.5 * 0.25 / kRadius);
}

TEST(Classify, AnUndecidableAnswerIsHeldAgainstNothing) {
  for (OracleAnswer answer : {OracleAnswer{}, oracle_hit()}) {
    answer.decidable = false;
    EXPECT_EQ(classify_found({}, answer).verdict, RayVerdict::undecidable);
    EXPECT_EQ(classify_found({7, 5.0}, answer).verdict, RayVerdict::undecidable);
    EXPECT_EQ(classify_found({8, 1.0}, answer).verdict, RayVerdict::undecidable);
  }
}

TEST(Classify, ANanComesBeforeEverything) {
  OracleAnswer undecidable = oracle_hit();
  undecidable.decidable = false;
  for (const OracleAnswer& answer : {OracleAnswer{}, oracle_hit(), undecidable}) {
    for (const uint triangle : {7U, 8U, NO_TRIANGLE}) {
      EXPECT_EQ(classify_found({triangle, 5.0, true}, answer).verdict, RayVerdict::not_a_number);
    }
  }
}

TEST(Classify, ADistanceThatIsNotFiniteIsNoHit) {
  for (const uint triangle : {7U, 8U}) {
    EXPECT_EQ(classify_found({triangle, kNan}, oracle_hit()).verdict, RayVerdict::not_a_number);
    EXPECT_EQ(classify_found({triangle, kInfinite}, oracle_hit()).verdict,
              RayVerdict::not_a_number);
    OracleAnswer answer = oracle_hit();
    answer.root.t = kNan;
    EXPECT_EQ(classify_found({triangle, 5.0}, answer).verdict, RayVerdict::not_a_number);
    answer = oracle_hit();
    answer.root.normal.z = kNan;
    EXPECT_EQ(classify_found({triangle, 5.0}, answer).verdict, RayVerdict::not_a_number);
    const FoundHit found{triangle, 5.0};
    EXPECT_EQ(classify(found, oracle_hit(), dvec3(0.0, 0.0, kNan), kRadius).verdict,
              RayVerdict::not_a_number);
    EXPECT_EQ(classify(found, oracle_hit(), kAlong, kNan).verdict, RayVerdict::not_a_number);
  }
}

// So that nobody sums up a distance that does not exist.
TEST(Classify, OnlyTwoHitsHaveADistance) {
  OracleAnswer undecidable = oracle_hit();
  undecidable.decidable = false;
  const OracleAnswer miss;
  for (const ClassifiedRay& ray :
       {classify_found({}, miss), classify_found({7, 5.0}, miss), classify_found({}, oracle_hit()),
        classify_found({7, 5.0, true}, oracle_hit()), classify_found({7, 5.0}, undecidable),
        classify_found({7, kNan}, oracle_hit())}) {
    EXPECT_FALSE(both_hit(ray.verdict));
    EXPECT_TRUE(std::isnan(ray.off_surface));
    EXPECT_TRUE(std::isnan(ray.depth_error));
  }
  for (const ClassifiedRay& ray :
       {classify_found({7, 5.0}, oracle_hit()), classify_found({8, 5.0}, oracle_hit()),
        classify_found({8, 6.0}, oracle_hit()), classify_found({7, 6.0}, oracle_hit())}) {
    EXPECT_TRUE(both_hit(ray.verdict));
    EXPECT_FALSE(std::isnan(ray.off_surface));
    EXPECT_FALSE(std::isnan(ray.depth_error));
  }
}

TEST(Classify, TakesACastHit) {
  const CastHit hit{2.5F, 0.25F, 0.5F, 7, 0, 0, 0, 0};
  EXPECT_EQ(found_hit(hit).triangle, 7U);
  EXPECT_EQ(found_hit(hit).depth, 2.5);
  EXPECT_FALSE(found_hit(hit).nan);
  for (float CastHit::*member : {&CastHit::z, &CastHit::u, &CastHit::v}) {
    for (const float bad : {kNanSingle, std::numeric_limits<float>::infinity()}) {
      CastHit broken = hit;
      broken.*member = bad;
      EXPECT_TRUE(found_hit(broken).nan);
    }
  }
}

}  // namespace
}  // namespace trisect
