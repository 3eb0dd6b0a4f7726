#include "app/mesh/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace trisect {
namespace {

using glm::dvec3;

// Twice the signed area of the triangles, and of the polygon, along z.
double cross_z(const dvec3& a, const dvec3& b, const dvec3& c) {
  return glm::cross(b - a, c - a).z;
}
double polygon_area(const std::vector<dvec3>& p) {
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) area += cross_z(p[0], p[i], p[i + 1]);
  return area;
}

// Every triangle turns the polygon's way and together they cover its area exactly once.
void expect_exact_cover(const std::vector<dvec3>& p) {
  uint64_t steps = 0;
  const auto triangles = triangulate(p, &steps);
  // Far from where corners are cut off unseen.
  EXPECT_LT(steps, most_triangulation_steps(p.size()) / 4);
  ASSERT_EQ(triangles.size(), p.size() - 2);
  const double whole = polygon_area(p);
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const double area = cross_z(p[a], p[b], p[c]);
    EXPECT_GE(area * whole, 0.0) << "a triangle is flipped";
    sum += area;
  }
  // A sum of numbers of order 1 that each round; some tens of them are large.
  EXPECT_NEAR(sum, whole, 1e-12 + 1e-16 * static_cast<double>(p.size()));
}

TEST(Triangulate, CutsAQuadAlongItsFirstDiagonal) {
  const auto triangles =
      triangulate(std::vector<dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  ASSERT_EQ(triangles.size(), 2U);
  EXPECT_EQ(triangles[0], (std::array<uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(triangles[1], (std::array<uint32_t, 3>{0, 2, 3}));
}

TEST(Triangulate, CutsAConcaveQuadAlongTheDiagonalInside) {
  // An arrowhead whose notch is corner 3: only the diagonal 1-3 lies inside.
  expect_exact_cover({{0, 2, 0}, {-1, -1, 0}, {0, 0, 0}, {1, -1, 0}});
  expect_exact_cover({{-1, -1, 0}, {0, 0, 0}, {1, -1, 0}, {0, 2, 0}});
}

TEST(Triangulate, CoversConcavePolygonsOfBothOrientations) {
  const std::vector<dvec3> comb{{0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 1, 0},
                                {3, 3, 0}, {2, 1, 0}, {1, 3, 0}, {0, 1, 0}};
  expect_exact_cover(comb);
  expect_exact_cover({comb.rbegin(), comb.rend()});
}

TEST(Triangulate, CoversACornerInTheMiddleOfAnEdge) {
  std::vector<dvec3> square{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  for (std::size_t first = 0; first < square.size(); ++first) {
    expect_exact_cover(square);
    // It is no corner of a triangle that has no area.
    for (const auto& [a, b, c] : triangulate(square)) {
      EXPECT_GT(cross_z(square[a], square[b], square[c]), 0.0) << first;
    }
    std::rotate(square.begin(), square.begin() + 1, square.end());
  }
}

TEST(Triangulate, CoversRandomStars) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> radius(0.2, 1.0);
  for (int k = 0; k < 200; ++k) {
    std::vector<dvec3> star;
    const int n = 5 + k % 40;
    for (int i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * i / n;
      const double r = radius(random);
      star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    }
    expect_exact_cover(star);
  }
}

// Corners by the ten thousand, as contours of maps and cut-outs have them.
TEST(Triangulate, CoversPolygonsOfManyCorners) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> radius(0.9, 1.0);
  constexpr int n = 20000;
  std::vector<dvec3> star;
  std::vector<dvec3> comb{{0, 0, 0}, {1, 0, 0}};
  for (int i = 0; i < n; ++i) {
    const double angle = 6.283185307179586 * i / n;
    const double r = radius(random);
    star.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
    comb.emplace_back(1.0 - static_cast<double>(i) / n, i % 2 == 0 ? 1.0 : 0.5, 0.0);
  }
  expect_exact_cover(star);
  expect_exact_cover(comb);
}

// A hundred thousand corners take about n log n steps, whatever their polygon is like. (Those that
// cut the ears in their order around the polygon would take hours: a run that does not end fails.)
constexpr std::size_t kMany = 100000;
constexpr double kTurn = 6.283185307179586;

dvec3 on_circle(double turns, double radius) {
  return {radius * std::cos(kTurn * turns), radius * std::sin(kTurn * turns), 0.0};
}

TEST(Triangulate, CoversHugeConvexPolygonsAndStars) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> radius(0.2, 1.0);
  std::vector<dvec3> convex;
  std::vector<dvec3> star;
  std::vector<dvec3> spikes;
  for (std::size_t i = 0; i < kMany; ++i) {
    const double at = static_cast<double>(i) / kMany;
    convex.push_back(on_circle(at, 1.0));
    star.push_back(on_circle(at, radius(random)));
    spikes.push_back(on_circle(at, i % 2 == 0 ? 0.01 : 1.0));
  }
  expect_exact_cover(convex);
  expect_exact_cover(star);
  expect_exact_cover({star.rbegin(), star.rend()});
  expect_exact_cover(spikes);
}

TEST(Triangulate, CoversHugeSpirals) {
  for (const double turns : {20.0, 4000.0}) {
    std::vector<dvec3> spiral;
    for (std::size_t i = 0; i < kMany; ++i) {
      const bool inward = i >= kMany / 2;
      const double at = static_cast<double>(inward ? kMany - 1 - i : i) / (kMany / 2.0);
      spiral.push_back(on_circle(turns * at, 0.1 + at + (inward ? 0.4 / turns : 0.0)));
    }
    expect_exact_cover(spiral);
  }
}

TEST(Triangulate, CoversHugeCombsAndEdgesOfManyCorners) {
  std::vector<dvec3> comb{{0, 0, 0}, {1, 0, 0}};
  std::vector<dvec3> edge;
  for (std::size_t i = 0; i < kMany; ++i) {
    const double at = static_cast<double>(i) / kMany;
    comb.emplace_back(1.0 - at, i % 2 == 0 ? 1.0 : 1e-9, 0.0);
    edge.emplace_back(at, 0.0, 0.0);
  }
  edge.insert(edge.end(), {{1, 1, 0}, {0.5, 0.5, 0}, {0, 1, 0}});
  expect_exact_cover(comb);
  expect_exact_cover(edge);
}

// A square with holes, each joined to its upper edge by a line that goes there and back.
TEST(Triangulate, CoversHugePolygonsThatTouchThemselves) {
  constexpr int holes = 20000;
  std::vector<dvec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  for (int i = 0; i < holes; ++i) {
    const double x = 1.0 - (i + 0.5) / holes;
    const double y = 0.5 + 0.3 * std::sin(13.0 * i);
    constexpr double size = 0.3 / holes;
    square.insert(square.end(), {{x, 1, 0},
                                 {x, y, 0},
                                 {x + size, y - size, 0},
                                 {x - size, y - size, 0},
                                 {x, y, 0},
                                 {x, 1, 0}});
  }
  square.emplace_back(0, 1, 0);
  expect_exact_cover(square);
}

TEST(Triangulate, LosesNoTriangleOfAHugePolygonThatCannotBeCovered) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  std::vector<dvec3> line;
  std::vector<dvec3> crossing;
  for (std::size_t i = 0; i < kMany; ++i) {
    const double at = number(random);
    line.emplace_back(at, 3.0 * at, 0.7 * at);
    crossing.emplace_back(at, number(random), 0.0);
  }
  for (const auto& polygon : {std::vector<dvec3>(kMany, dvec3(1.0)), line, crossing}) {
    uint64_t steps = 0;
    EXPECT_EQ(triangulate(polygon, &steps).size(), kMany - 2);
    EXPECT_LT(steps, 2 * most_triangulation_steps(kMany));
  }
}

TEST(Triangulate, WorksInEveryPlane) {
  // The arrowhead in the planes x = 0 and y = 0: four points, two triangles, the same way around.
  const std::vector<dvec3> flat{{0, 2, 0}, {-1, -1, 0}, {0, 0, 0}, {1, -1, 0}};
  for (const int turn : {1, 2}) {
    std::vector<dvec3> turned;
    turned.reserve(flat.size());
    for (const dvec3& p : flat) {
      turned.push_back(turn == 1 ? dvec3(p.z, p.x, p.y) : dvec3(p.y, p.z, p.x));
    }
    EXPECT_EQ(triangulate(turned), triangulate(flat));
  }
}

TEST(Triangulate, LosesNoTriangleOfAPolygonWithoutArea) {
  EXPECT_EQ(triangulate(std::vector<dvec3>(6, dvec3(1.0))).size(), 4U);
  EXPECT_EQ(triangulate(std::vector<dvec3>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size(), 2U);
}

}  // namespace
}  // namespace trisect
