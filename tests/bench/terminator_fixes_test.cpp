// What renderers do about the shadow terminator, where it is known what must come of it.
#include "app/bench/terminator_fixes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace trisect {
namespace {

using bench::SmoothPoint;
using glm::vec3;

vec3 any_direction(std::mt19937_64& random) {
  std::normal_distribution<float> normal;
  return glm::normalize(vec3(normal(random), normal(random), normal(random)));
}

// A triangle in the unit sphere, of edges of some 0.5, and a point within.
SmoothPoint in_sphere(std::mt19937_64& random) {
  std::uniform_real_distribution<float> unit(0.1F, 1.0F);
  SmoothPoint point{};
  const vec3 middle = any_direction(random);
  const vec3 right = glm::normalize(glm::cross(middle, any_direction(random)));
  const vec3 up = glm::cross(middle, right);
  for (std::size_t k = 0; k < 3; ++k) {
    const float angle = 2.0944F * static_cast<float>(k);
    point.normals[k] =
        glm::normalize(middle + 0.3F * (std::cos(angle) * right + std::sin(angle) * up));
    point.vertices[k] = point.normals[k];
  }
  const vec3 weights(unit(random), unit(random), unit(random));
  point.weights = weights / (weights.x + weights.y + weights.z);
  return point;
}

vec3 face_of(const SmoothPoint& point) {
  return glm::normalize(
      glm::cross(point.vertices[1] - point.vertices[0], point.vertices[2] - point.vertices[0]));
}

// Tangent planes of a sphere are outside of it, and a triangle in it is within. How far off the
// sphere they are in the middle is about half of a vertex's square distance.
TEST(TerminatorFixes, RaiseATriangleInASphereOutOfIt) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 10000; ++i) {
    const SmoothPoint point = in_sphere(random);
    const vec3 face = face_of(point);
    const vec3 grazing = glm::normalize(glm::cross(face, any_direction(random)));
    const float flat = glm::length(point.position());
    ASSERT_LT(flat, 0.9999F);
    const float by_planes = glm::length(bench::on_tangent_planes(point));
    const float by_envelope = glm::length(bench::under_envelope(point, face, grazing));
    EXPECT_GT(by_planes, 0.99999F);
    EXPECT_LT(by_planes, 1.1F);
    EXPECT_GT(by_envelope, flat + 0.4F * (1.0F - flat));
    EXPECT_LT(by_envelope, 1.1F);
  }
}

// The same triangle with its normals turned, of a bowl, lies above all tangent planes.
TEST(TerminatorFixes, OfHanikaLeaveABowlAsItIs) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 10000; ++i) {
    SmoothPoint point = in_sphere(random);
    for (vec3& normal : point.normals) normal = -normal;
    EXPECT_EQ(bench::on_tangent_planes(point), point.position());
  }
}

TEST(TerminatorFixes, LeaveAFlatTriangleAsItIs) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 10000; ++i) {
    SmoothPoint point = in_sphere(random);
    const vec3 face = face_of(point);
    for (vec3& normal : point.normals) normal = face;
    const vec3 at = point.position();
    EXPECT_LT(glm::length(bench::on_tangent_planes(point) - at), 1e-6F);
    EXPECT_LT(glm::length(bench::under_envelope(point, face, any_direction(random)) - at), 1e-6F);
  }
}

// All the way at a right angle to the light, and less from where the two cosines come to more than
// 0.1.
TEST(TerminatorFixes, OfCyclesWorkWhereLightGrazes) {
  SmoothPoint point{{vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0)},
                    {vec3(-0.6F, 0, 0.8F), vec3(0.6F, 0, 0.8F), vec3(0, 0.6F, 0.8F)},
                    vec3(0.4F, 0.4F, 0.2F)};
  const vec3 face(0, 0, 1);
  const auto raised = [&](float cosine) {
    const vec3 light(std::sqrt(1.0F - cosine * cosine), 0.0F, cosine);
    return glm::length(bench::under_envelope(point, face, light) - point.position());
  };
  const float whole = raised(0.0F);
  EXPECT_GT(whole, 0.01F);
  EXPECT_NEAR(raised(0.05F), whole, 1e-6F);
  EXPECT_GT(raised(0.09F), 0.0F);
  EXPECT_LT(raised(0.09F), whole);
  EXPECT_EQ(raised(0.2F), 0.0F);
}

// In the middle of a triangle in a sphere, whose vertices are b off its axis and a along it, all
// three tangent planes are b^2 higher along their normals, and half of the paraboloid is half of
// that.
TEST(TerminatorFixes, OfCyclesRaiseToTheTangentPlanes) {
  std::mt19937_64 random(4);
  SmoothPoint point = in_sphere(random);
  point.weights = vec3(1.0F / 3.0F);
  const vec3 face = face_of(point);
  const vec3 grazing = glm::normalize(glm::cross(face, any_direction(random)));
  const float a = glm::dot(face, point.vertices[0]);
  EXPECT_NEAR(glm::length(bench::under_envelope(point, face, grazing)), a * (2.0F - a * a), 1e-6F);
}

TEST(TerminatorFixes, OfChiangDimByTheTrianglesAngle) {
  const vec3 up(0, 0, 1);
  // The three directions are one: nothing is dimmed.
  EXPECT_FLOAT_EQ(bench::softening(up, up, up), 1.0F);
  // The triangle faces away.
  EXPECT_EQ(bench::softening(up, vec3(0.6F, 0, 0.8F), vec3(0.8F, 0, -0.6F)), 0.0F);
  const vec3 normal(0.6F, 0, 0.8F);
  const vec3 light(0.8F, 0, 0.6F);
  const float g = 0.6F / (0.96F * 0.8F);
  EXPECT_NEAR(bench::softening(up, normal, light), -g * g * g + g * g + g, 1e-6F);
}

}  // namespace
}  // namespace trisect
