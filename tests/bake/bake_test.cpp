#include "app/bake/bake.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>

#include "app/base/error.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

// One rounding to single precision of a number of order 1.
constexpr float kUlp = 1.2e-7F;

TEST(Bake, MatchesValuesWorkedOutByHand) {
  // The right triangle (0,0,0) (4,0,0) (0,3,0) with n = z; its box is centred on (2, 1.5, 0).
  // Vertex 1 leans out by the angle of the triangle 3-4-5, vertex 2 inward.
  const Mesh mesh = test::one_triangle({dvec3(0, 0, 0), dvec3(4, 0, 0), dvec3(0, 3, 0)},
                                       {dvec3(0, 0, 1), dvec3(0.6, 0, 0.8), dvec3(0, -0.6, 0.8)});
  const BakedScene scene = bake(mesh, {SURFACE_FLAT, 0.65});
  EXPECT_EQ(scene.origin, dvec3(2.0, 1.5, 0.0));
  ASSERT_EQ(scene.triangles.size(), 1U);
  const Triangle& tri = scene.triangles[0];
  EXPECT_EQ(tri.Position[0], vec4(-2.0F, -1.5F, 0.0F, 0.0F));
  EXPECT_EQ(tri.Position[1], vec4(2.0F, -1.5F, 0.0F, 0.0F));
  EXPECT_EQ(tri.Position[2], vec4(-2.0F, 1.5F, 0.0F, 0.0F));
  EXPECT_EQ(tri.Normal[1], vec4(0.6F, 0.0F, 0.8F, 0.0F));
  EXPECT_EQ(tri.TriNormal, vec4(0.0F, 0.0F, 1.0F, 5.0F));
  EXPECT_EQ(tri.NormDot, vec4(1.0F, 0.8F, 0.8F, 0.0F));

  // c_ij = -2 E_ij.N_i / |E_ij|^2, the lower-numbered neighbour first; then the angle at the
  // vertex.
  EXPECT_EQ(tri.VertexData[0].x, 0.0F);
  EXPECT_EQ(tri.VertexData[0].y, 0.0F);
  EXPECT_NEAR(tri.VertexData[0].z, std::acos(-1.0F) / 2.0F, kUlp);
  EXPECT_NEAR(tri.VertexData[1].x, -2.0F * (-4.0F * 0.6F) / 16.0F, kUlp);  // toward vertex 0
  EXPECT_NEAR(tri.VertexData[1].y, -2.0F * (-4.0F * 0.6F) / 25.0F, kUlp);  // toward vertex 2
  EXPECT_NEAR(tri.VertexData[1].z, std::atan2(3.0F, 4.0F), kUlp);
  EXPECT_NEAR(tri.VertexData[2].x, -2.0F * (-3.0F * -0.6F) / 9.0F, kUlp);
  EXPECT_NEAR(tri.VertexData[2].y, -2.0F * (-3.0F * -0.6F) / 25.0F, kUlp);
  EXPECT_NEAR(tri.VertexData[2].z, std::atan2(4.0F, 3.0F), kUlp);

  // The smallest ball about a right triangle has the hypotenuse as diameter; enclosing_ball may be
  // 1% larger.
  EXPECT_GE(tri.Domain.w, 2.5F);
  EXPECT_LE(tri.Domain.w, 2.5F * 1.01F);
}

TEST(Bake, CurvatureOfASphereIsItsInverseRadius) {
  for (const char* name : {"sphere-20", "sphere-80", "sphere-320"}) {
    for (const Triangle& tri : bake(test::load_asset(name), {SURFACE_SPHERE, 0.0}).triangles) {
      for (const vec4& data : tri.VertexData) {
        // Positions and normals are rounded to 6e-8; E.N is 0.037 over the shortest edge, 0.27.
        EXPECT_NEAR(data.x, 1.0F, 3e-6F) << name;
        EXPECT_NEAR(data.y, 1.0F, 3e-6F) << name;
      }
    }
  }
}

// All that the kernels take is of the vertices and normals as they are stored: baking what is
// stored gives the same bits.
TEST(Bake, IsOfTheRoundedVertices) {
  for (const char* name : {"teapot", "torus", "relief"}) {
    const Mesh mesh = test::load_asset(name);
    for (const SurfaceChoice& choice : {SurfaceChoice{}, SurfaceChoice{SURFACE_SPHERE, 0.0}}) {
      for (const Triangle& tri : bake(mesh, choice).triangles) {
        const auto stored = [](const auto& v) {
          return std::array{dvec3(v[0]), dvec3(v[1]), dvec3(v[2])};
        };
        const Triangle again = bake_triangle(stored(tri.Position), stored(tri.Normal), choice);
        using Numbers = std::array<float, sizeof(Triangle) / sizeof(float)>;
        EXPECT_EQ(std::bit_cast<Numbers>(tri), std::bit_cast<Numbers>(again)) << name;
      }
    }
  }
}

TEST(Bake, KeepsItsDigitsFarFromTheOrigin) {
  Mesh mesh = test::load_asset("sphere-20");
  const BakedScene near = bake(mesh, {});
  const dvec3 away(1e6, -2e6, 3e6);  // its sums with the vertices are exact to 5e-10
  for (dvec3& p : mesh.positions) p += away;
  const BakedScene far = bake(mesh, {});
  EXPECT_LT(glm::distance(far.origin, near.origin + away), 1e-9);
  for (std::size_t i = 0; i < near.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_LT(glm::distance(near.triangles[i].Position[k], far.triangles[i].Position[k]), kUlp);
    }
  }
}

TEST(Bake, RadiusContainsEveryDomain) {
  const BakedScene scene = bake(test::load_asset("teapot"), {SURFACE_PHONG, 1.0});
  for (const Triangle& tri : scene.triangles) {
    EXPECT_LE(glm::length(dvec3(tri.Domain)) + static_cast<double>(tri.Domain.w), scene.radius);
  }
}

TEST(Bake, RefusesWhatSinglePrecisionCannotHold) {
  const auto triangle = [](double size) {
    return test::one_triangle({dvec3(0, 0, 0), dvec3(size, 0, 0), dvec3(0, size, 0)},
                              {dvec3(0, 0, 1), dvec3(0, 0, 1), dvec3(0, 0, 1)});
  };
  for (const double size : {1e-200, 1e-10, 1e10, 1e200}) {
    EXPECT_THROW(bake(triangle(size), {}), InputError) << size;
  }
  for (const double size : {1e-8, 1e8}) EXPECT_NO_THROW(bake(triangle(size), {})) << size;
}

}  // namespace
}  // namespace trisect
