// Distances between surfaces, against what is known of them and against a search without a tree.
#include "app/bench/mesh_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "app/base/threads.h"
#include "app/bench/decimated.h"
#include "app/bench/nearest_point.h"

namespace trisect::bench {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::uvec3;

// `cells` x `cells` squares of two triangles over the square from low to high, at these heights,
// but for the triangles that `leaves_out` names.
FlatMesh grid_of_heights(uint32_t cells, double low, double high,
                         const std::function<double(const dvec2&)>& height,
                         const std::function<bool(uint32_t)>& leaves_out = {}) {
  FlatMesh mesh;
  for (uint32_t j = 0; j <= cells; ++j) {
    for (uint32_t i = 0; i <= cells; ++i) {
      const dvec2 at = low + (high - low) * dvec2(i, j) / static_cast<double>(cells);
      mesh.positions.emplace_back(at, height(at));
      mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
    }
  }
  for (uint32_t j = 0; j < cells; ++j) {
    for (uint32_t i = 0; i < cells; ++i) {
      const uint32_t corner = j * (cells + 1) + i;
      for (const uvec3& triangle : {uvec3(0, 1, cells + 2), uvec3(0, cells + 2, cells + 1)}) {
        const auto number = static_cast<uint32_t>(mesh.triangles.size() + mesh.patches.size());
        if (leaves_out && leaves_out(number)) {
          mesh.patches.push_back(number);  // counted only
          continue;
        }
        mesh.triangles.push_back(corner + triangle);
      }
    }
  }
  mesh.patches.clear();
  return mesh;
}

double flat(const dvec2&) {
  return 0.0;
}

double wave(const dvec2& at) {
  return 0.1 * std::sin(5.0 * at.x) * std::cos(4.0 * at.y);
}

double nearest_of_all(const FlatMesh& mesh, const dvec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    least = std::min(least, nearest_of_triangle(mesh, t, point).distance);
  }
  return least;
}

dvec3 point_of(const FlatMesh& mesh, const NearPoint& near) {
  const uvec3& at = mesh.triangles[near.triangle];
  return mesh.positions[at.x] * near.weights.x + mesh.positions[at.y] * near.weights.y +
         mesh.positions[at.z] * near.weights.z;
}

// The largest distance among points that lie closely on all triangles.
double largest_of_many(const FlatMesh& from, const FlatMesh& to) {
  double largest = 0.0;
  constexpr int parts = 6;
  for (const uvec3& at : from.triangles) {
    for (int i = 0; i <= parts; ++i) {
      for (int j = 0; i + j <= parts; ++j) {
        const dvec3 w = dvec3(i, j, parts - i - j) / static_cast<double>(parts);
        largest = std::max(
            largest, nearest_of_all(to, from.positions[at.x] * w.x + from.positions[at.y] * w.y +
                                            from.positions[at.z] * w.z));
      }
    }
  }
  return largest;
}

LargestDistance largest(const FlatMesh& from, const FlatMesh& to, double resolution = 1e-6) {
  return largest_distance(from, Target(to), resolution).value();
}

// The search ends when the bound is a hundredth and the resolution above what was found.
void expect_close(const LargestDistance& distance, double resolution = 1e-6) {
  EXPECT_GE(distance.bound, distance.found);
  EXPECT_LE(distance.bound, 1.01 * distance.found + resolution);
}

// The largest distance lies between these two, and is bounded closely.
void expect_between(const LargestDistance& distance, double least, double most) {
  EXPECT_LE(distance.found, most);
  EXPECT_GE(distance.bound, least);
  expect_close(distance);
}

TEST(NearestPoint, IsThatOfASearchOfAllTriangles) {
  FlatMesh mesh = grid_of_heights(9, -1.0, 1.0, wave);
  // Triangles without area are a line and a point.
  mesh.triangles.emplace_back(0, 1, 1);
  mesh.triangles.emplace_back(99, 99, 99);
  // Far from the origin, where single precision has two digits less.
  for (dvec3& position : mesh.positions) position += dvec3(300.0, -200.0, 100.0);
  const NearestPoint nearest(mesh);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-2.0, 2.0);
  for (int k = 0; k < 2000; ++k) {
    const dvec3 point =
        dvec3(300.0, -200.0, 100.0) + dvec3(anywhere(random), anywhere(random), anywhere(random));
    const NearPoint found = nearest.to(point);
    EXPECT_NEAR(found.distance, nearest_of_all(mesh, point), 1e-13);
    EXPECT_NEAR(glm::distance(point, point_of(mesh, found)), found.distance, 1e-12);
  }
}

// Single precision cannot tell which of them is the nearest.
TEST(NearestPoint, IsTheNearestOfThreeThatAreNearlyAsNear) {
  // Three sides of a cube; the boxes of their triangles are as flat as they are.
  FlatMesh sides;
  const FlatMesh side = grid_of_heights(8, -1.0, 1.0, [](const dvec2&) { return 1.0; });
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    const auto first = static_cast<uint32_t>(sides.positions.size());
    for (const dvec3& p : side.positions) {
      sides.positions.emplace_back(p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]);
    }
    for (const uvec3& triangle : side.triangles) sides.triangles.push_back(first + triangle);
  }
  const NearestPoint nearest(sides);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> apart(-1e-8, 1e-8);
  for (int k = 0; k < 1000; ++k) {
    const dvec3 point = 0.3 + 1e-4 * k + dvec3(apart(random), apart(random), apart(random));
    EXPECT_NEAR(nearest.to(point).distance, nearest_of_all(sides, point), 1e-13);
  }
}

TEST(LargestDistance, IsKnownBetweenPlanes) {
  const FlatMesh low = grid_of_heights(3, 0.0, 1.0, flat);
  const FlatMesh high = grid_of_heights(7, 0.0, 1.0, [](const dvec2&) { return 0.25; });
  const LargestDistance distance = largest(low, high);
  EXPECT_NEAR(distance.found, 0.25, 1e-15);
  // The borders of both are one above the other.
  EXPECT_NEAR(distance.bound, 0.25, 1e-8);
  // The larger of the two reaches beyond the other.
  const FlatMesh wide = grid_of_heights(4, 0.0, 2.0, flat);
  expect_between(largest(wide, low), std::sqrt(2.0), std::sqrt(2.0) * (1.0 + 1e-12));
  expect_between(largest(low, wide), 0.0, 1e-12);
}

TEST(LargestDistance, HoldsForEveryPointOfASurface) {
  const FlatMesh coarse = grid_of_heights(4, -1.0, 1.0, wave);
  const FlatMesh fine = grid_of_heights(20, -1.0, 1.0, wave);
  for (const auto& [from, to] : {std::pair{&coarse, &fine}, std::pair{&fine, &coarse}}) {
    const double sampled_largest = largest_of_many(*from, *to);
    const LargestDistance distance = largest(*from, *to);
    EXPECT_GE(distance.bound, sampled_largest);
    expect_close(distance);
  }
}

// Near surfaces, where a bound by one triangle of the target would be as large as a triangle.
TEST(LargestDistance, IsBoundedCloselyWhereSurfacesAreNear) {
  const FlatMesh one = grid_of_heights(13, -1.0, 1.0, wave);
  const FlatMesh other =
      grid_of_heights(17, -1.0, 1.0, [](const dvec2& at) { return wave(at) + 1e-5 * at.x; });
  const LargestDistance distance = largest(one, other);
  EXPECT_GE(distance.bound, largest_of_many(one, other));
  expect_close(distance);
  // Looked at from the other side, too.
  FlatMesh turned = other;
  for (uvec3& triangle : turned.triangles) std::swap(triangle.x, triangle.y);
  expect_close(largest(one, turned));
  // Triangles with vertices of their own, at the same places, are neighbours as well.
  FlatMesh split;
  for (const uvec3& triangle : other.triangles) {
    const auto first = static_cast<uint32_t>(split.positions.size());
    for (glm::length_t k = 0; k < 3; ++k) split.positions.push_back(other.positions[triangle[k]]);
    split.triangles.emplace_back(first, first + 1, first + 2);
  }
  split.normals.assign(split.positions.size(), {0.0F, 0.0F, 1.0F});
  expect_close(largest(one, split));
}

// The same where there are too many triangles over each of the surface's.
TEST(LargestDistance, IsBoundedCloselyByQuarters) {
  const FlatMesh plane = grid_of_heights(1, -1.0, 1.0, flat);
  const FlatMesh fine =
      grid_of_heights(180, -1.0, 1.0, [](const dvec2& at) { return 1e-4 * wave(at); });
  const LargestDistance distance = largest(plane, fine, 1e-7);
  // The wave's height; its top is hit by vertices to a hundredth.
  EXPECT_NEAR(distance.found, 1e-5, 1e-7);
  expect_close(distance, 1e-7);
}

// What the target does not cover is not taken for covered: under a hole, a fold and a crack.
TEST(LargestDistance, DoesNotTakeAHoleForCovered) {
  const FlatMesh plane = grid_of_heights(1, 0.2, 0.8, [](const dvec2&) { return 1e-3; });
  const FlatMesh holed =
      grid_of_heights(10, 0.0, 1.0, flat, [](uint32_t number) { return number == 110; });
  expect_between(largest(plane, holed), largest_of_many(plane, holed), 0.1);
  EXPECT_GT(largest(plane, holed).found, 0.02);

  // Between 0.4 and 0.6 there is a gap: both sides go back below themselves, and meet far down.
  FlatMesh folded = grid_of_heights(20, 0.0, 1.0, flat);
  for (dvec3& position : folded.positions) {
    if (std::abs(position.x - 0.45) < 0.01) position = dvec3(0.3, position.y, -0.1);
    if (std::abs(position.x - 0.5) < 0.01) position = dvec3(0.5, position.y, -1.0);
    if (std::abs(position.x - 0.55) < 0.01) position = dvec3(0.7, position.y, -0.1);
  }
  expect_between(largest(plane, folded), largest_of_many(plane, folded), 0.11);
  EXPECT_GT(largest(plane, folded).found, 0.098);

  FlatMesh cracked = grid_of_heights(10, 0.0, 1.0, flat);
  // One triangle's corner is moved away from those that it had it in common with.
  cracked.positions.push_back(cracked.positions[cracked.triangles[110].z] +
                              dvec3(-0.07, -0.02, 0.0));
  cracked.normals.push_back(cracked.normals[0]);
  cracked.triangles[110].z = static_cast<uint32_t>(cracked.positions.size() - 1);
  expect_between(largest(plane, cracked), largest_of_many(plane, cracked), 0.1);
}

TEST(LargestDistance, HasTwoWays) {
  FlatMesh spiked = grid_of_heights(10, 0.0, 1.0, flat);
  spiked.positions[5 * 11 + 5].z = 0.5;
  const FlatMesh plane = grid_of_heights(1, 0.0, 1.0, flat);
  expect_between(largest(spiked, plane), 0.5, 0.5 + 1e-12);
  const LargestDistance back = largest(plane, spiked);
  EXPECT_LT(back.bound, 0.1);
  EXPECT_GE(back.bound, largest_of_many(plane, spiked));
}

TEST(SampledDistances, AreKnownBetweenPlanes) {
  const FlatMesh low = grid_of_heights(3, 0.0, 1.0, flat);
  // Inclined by 3/4: the distance along the plane's normal is 4/5 of the height.
  const FlatMesh inclined =
      grid_of_heights(2, -3.0, 3.0, [](const dvec2& at) { return 1.0 + 0.75 * at.x; });
  const Samples level = sampled(low, Target(inclined), 20000).value();
  EXPECT_NEAR(level.distance.max, 0.8 * 1.75, 1e-3);
  // Heights from 1 to 1.75, spread evenly; a root of 20000 samples is 140.
  EXPECT_NEAR(level.distance.p50, 0.8 * 1.375, 0.01);
  EXPECT_NEAR(level.rms, 0.8 * std::sqrt((std::pow(1.75, 3) - 1.0) / 3.0 / 0.75), 0.01);
  // The target's interpolated normals are those of the plane here.
  EXPECT_NEAR(level.face_degrees.max, 0.0, 1e-6);
  const Samples slope = sampled(inclined, Target(low), 100).value();
  EXPECT_NEAR(slope.face_degrees.p50, 36.8699, 1e-4);
  EXPECT_NEAR(slope.shading_degrees.p50, 0.0, 1e-6);
}

// A triangle so thin that its normal is one of roundings.
TEST(LargestDistance, HoldsForSlivers) {
  const FlatMesh fine =
      grid_of_heights(30, -1.0, 1.0, [](const dvec2& at) { return 1e-3 * wave(at); });
  for (const double width : {1e-3, 1e-6, 1e-8, 1e-9, 1e-12, 0.0}) {
    FlatMesh sliver;
    sliver.positions = {{-0.7, -0.31, 0.1}, {0.63, 0.29, -0.2}, {0.0, width, 0.05 * width}};
    sliver.positions[2] += 0.4 * sliver.positions[0] + 0.6 * sliver.positions[1];
    sliver.normals.assign(3, {0.0F, 0.0F, 1.0F});
    sliver.triangles = {{0, 1, 2}};
    const LargestDistance distance = largest(sliver, fine);
    EXPECT_GE(distance.bound, largest_of_many(sliver, fine)) << width;
    expect_close(distance);
    // The other way it is a line, as far from the corners of the grid as they are from its ends.
    const LargestDistance back = largest(fine, sliver);
    EXPECT_GE(back.bound, largest_of_many(fine, sliver)) << width;
    expect_close(back);
  }
}

TEST(LargestDistance, IsTheSameAtEveryScaleAndOnEveryNumberOfThreads) {
  const FlatMesh coarse = grid_of_heights(4, -1.0, 1.0, wave);
  const FlatMesh fine = grid_of_heights(20, -1.0, 1.0, wave);
  const LargestDistance distance = largest(fine, coarse);
  set_worker_threads(1);
  const LargestDistance alone = largest(fine, coarse);
  set_worker_threads(0);
  EXPECT_EQ(alone.found, distance.found);
  EXPECT_EQ(alone.bound, distance.bound);
  const auto scaled = [](FlatMesh mesh, double scale) {
    for (dvec3& position : mesh.positions) position *= scale;
    return mesh;
  };
  // Powers of two change no digit.
  for (const double scale : {std::exp2(-30), std::exp2(30)}) {
    const FlatMesh large = scaled(coarse, scale);
    const LargestDistance other =
        largest_distance(scaled(fine, scale), Target(large), 1e-6 * scale).value();
    EXPECT_EQ(other.found, scale * distance.found);
    EXPECT_EQ(other.bound, scale * distance.bound);
  }
}

TEST(LargestDistance, TellsItsProgressForward) {
  const FlatMesh plane = grid_of_heights(1, -1.0, 1.0, flat);
  const FlatMesh fine = grid_of_heights(180, -1.0, 1.0, wave);
  double last = 0.0;
  const auto told = [&](double done) {
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1.0);
    last = done;
    return true;
  };
  ASSERT_TRUE(largest_distance(plane, Target(fine), 1e-6, told));
  EXPECT_GT(last, 0.5);
}

TEST(Distances, EndWhenTheyAreStopped) {
  const FlatMesh plane = grid_of_heights(2, 0.0, 1.0, flat);
  const Target target(plane);
  const auto stop = [](double) { return false; };
  EXPECT_FALSE(largest_distance(plane, target, 1e-6, stop));
  EXPECT_FALSE(sampled(plane, target, 10, stop));
}

// A plane keeps its place and normals with as few triangles as are asked for.
TEST(Decimated, HasSoManyTriangles) {
  FlatMesh plane = grid_of_heights(16, 0.0, 1.0, flat);
  for (dvec3& position : plane.positions) position += dvec3(1e6, 0.0, 0.0);
  const Mesh coarse = decimated(plane, 100, "plane");
  EXPECT_LE(coarse.triangles.size(), 100U);
  EXPECT_GT(coarse.triangles.size(), 90U);
  for (const dvec3& position : coarse.positions) {
    EXPECT_EQ(position.z, 0.0);
    // Vertices are those of the plane, with their digits in double precision.
    EXPECT_EQ(std::fmod(16.0 * (position.x - 1e6), 1.0), 0.0);
  }
  for (const dvec3& normal : coarse.normals) EXPECT_EQ(normal, dvec3(0.0, 0.0, 1.0));
}

}  // namespace
}  // namespace trisect::bench
