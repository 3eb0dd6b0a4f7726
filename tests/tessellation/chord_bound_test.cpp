// The distance of flat triangles from the surface: bounds against samples.
#include "app/tessellation/chord_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "app/surface/sphere_range.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

// Three points of a patch, so many times closer together than its vertices.
CornerWeights random_piece(std::mt19937_64& random, int halvings) {
  // Now and then at a vertex, where the sphere surface's derivatives turn.
  const dvec3 about = random() % 4 == 0 ? dvec3(0.0, 1.0, 0.0) : test::random_weights(random);
  CornerWeights piece{};
  for (dvec3& corner : piece) {
    corner = about + (test::random_weights(random) - about) * std::ldexp(1.0, -halvings);
  }
  if (random() % 4 == 0) piece[0] = about;
  return piece;
}

// The largest |S - L| at many points of a piece.
double largest_chord(const in_double::Shape& shape, const Patch& patch,
                     const CornerWeights& piece) {
  std::array<dvec3, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = in_double::surface_point(shape, patch.triangle, piece[k]);
  }
  double largest = 0.0;
  for (const dvec3& l : test::weight_grid(12)) {
    const dvec3 point = in_double::surface_point(shape, patch.triangle, weigh(l, piece));
    largest = std::max(largest, glm::distance(point, weigh(l, corners)));
  }
  return largest;
}

struct Tightness {
  std::vector<double> ratios;  // of bounds to samples

  [[nodiscard]] double median() {
    std::nth_element(ratios.begin(),
                     ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
    return ratios[ratios.size() / 2];
  }
};

// Holds chord_bound to samples of random patches and returns how much larger it is.
Tightness hold(const SurfaceChoice& choice, double spread, int halvings) {
  std::mt19937_64 random(31);
  const in_double::Shape shape = shape_of(choice);
  Tightness tightness;
  for (int i = 0; i < 2000; ++i) {
    const test::RandomPatch shape_of_patch = test::random_patch(random, spread);
    const Patch patch = patch_of(
        SHELL_NORMAL, bake_triangle(shape_of_patch.positions, shape_of_patch.normals, choice));
    const CornerWeights piece = random_piece(random, halvings);
    const double bound = chord_bound(choice, patch, piece);
    const double largest = largest_chord(shape, patch, piece);
    // The samples' own roundings: a few of numbers near 1.
    EXPECT_GE(bound, largest - 1e-15) << i << ", " << halvings << " halvings";
    if (largest > 1e-13) tightness.ratios.push_back(bound / largest);
  }
  return tightness;
}

TEST(ChordBound, HoldsAndIsTightForPhong) {
  for (const double spread : {20.0, 80.0}) {
    for (const int halvings : {0, 1, 3, 6, 10}) {
      Tightness tightness = hold({SURFACE_PHONG, 0.65, SHELL_NORMAL}, spread, halvings);
      // The three edges of a cubic bend apart; of a small piece, a quadratic, together.
      EXPECT_LT(tightness.median(), halvings > 2 ? 1.2 : 1.5) << halvings;
    }
  }
}

// The ranges are of no use before a piece is small beside its distance from the vertices' spheres.
TEST(ChordBound, HoldsForBlendedSpheres) {
  for (const double spread : {5.0, 30.0, 80.0}) {
    for (const int halvings : {0, 1, 3, 6, 10}) {
      Tightness tightness = hold({SURFACE_SPHERE, 0.0, SHELL_NORMAL}, spread, halvings);
      if (halvings >= 6 && spread < 40.0) {
        EXPECT_LT(tightness.median(), 2.5) << halvings;
      }
    }
  }
}

TEST(ChordBound, OfFlatTrianglesIsZero) {
  std::mt19937_64 random(7);
  const SurfaceChoice choice{SURFACE_FLAT, 0.0, SHELL_NORMAL};
  const test::RandomPatch flat = test::random_patch(random, 30.0);
  const Patch patch = patch_of(SHELL_NORMAL, bake_triangle(flat.positions, flat.normals, choice));
  EXPECT_EQ(chord_bound(choice, patch, corner_weights(kWholeTriangle)), 0.0);
}

// Against differences of the derivatives that shaders/surface.glsl has.
TEST(SphereRanges, HoldSecondDerivatives) {
  std::mt19937_64 random(5);
  const SurfaceChoice choice{SURFACE_SPHERE, 0.0, SHELL_NORMAL};
  const in_double::Shape shape = shape_of(choice);
  std::size_t held = 0;
  for (int i = 0; i < 3000; ++i) {
    const test::RandomPatch corners = test::random_patch(random, i % 2 == 0 ? 10.0 : 40.0);
    const Patch patch =
        patch_of(SHELL_NORMAL, bake_triangle(corners.positions, corners.normals, choice));
    const CornerWeights piece = random_piece(random, 1 + i % 8);
    const auto ranges = sphere_second_derivative_ranges(patch, piece);
    if (!ranges) continue;
    const dvec3 w = weigh(dvec3(0.3, 0.3, 0.4), piece);
    if (std::min({w.x, w.y, w.z}) < 0.01) continue;
    for (int k = 0; k < 3; ++k) {
      dvec3 d(0.0);
      d[k] = -1.0;
      d[(k + 1) % 3] = 1.0;
      const auto along = [&](double step) {
        const in_double::Displacement sigma =
            in_double::displacement_and_derivatives(shape, patch.triangle, w + d * step);
        return sigma.u * d.y + sigma.v * d.z;
      };
      constexpr double step = 1e-5;
      const double second = (along(step) - along(-step)) / (2.0 * step);
      const Interval& range = (*ranges)[static_cast<std::size_t>(k)];
      // The difference's own error: its roundings over the step, and the step squared.
      const double slack = 1e-7 * (1.0 + std::abs(second));
      EXPECT_GE(second, range.lo - slack) << i;
      EXPECT_LE(second, range.hi + slack) << i;
      ++held;
    }
  }
  EXPECT_GT(held, 3000U);
}

}  // namespace
}  // namespace trisect
