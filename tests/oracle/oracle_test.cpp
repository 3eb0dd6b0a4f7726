// The oracle against closed forms and brute force that share none of its search.
#include "app/oracle/oracle.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <random>
#include <stdexcept>

#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

// Float positions and normals of a unit sphere are off by some 6e-8 each; the curvatures, quotients
// of them, by a few times that.
constexpr double kBakedRounding = 1e-6;

dvec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(dvec3(normal(random), normal(random), normal(random)));
}

OracleRay random_ray_at(const dvec3& target, double distance, std::mt19937_64& random) {
  const dvec3 direction = random_direction(random);
  return {target - direction * distance, direction};
}

BakedScene scene_of(const std::vector<test::RandomPatch>& patches, const SurfaceChoice& choice) {
  BakedScene scene;
  scene.choice = choice;
  for (const test::RandomPatch& patch : patches) {
    scene.triangles.push_back(bake_triangle(patch.positions, patch.normals, choice));
  }
  return scene;
}

// Moeller & Trumbore 1997, two-sided: t, or NaN. `clear`: not within rounding of an edge.
double meet_triangle(const OracleRay& ray, const dvec3& a, const dvec3& b, const dvec3& c,
                     bool& clear) {
  const dvec3 p = glm::cross(ray.direction, c - a);
  const double determinant = glm::dot(b - a, p);
  const dvec3 s = ray.origin - a;
  const double u = glm::dot(s, p) / determinant;
  const dvec3 q = glm::cross(s, b - a);
  const double v = glm::dot(ray.direction, q) / determinant;
  const double t = glm::dot(c - a, q) / determinant;
  // Far above the rounding of u and v, 1e-15 over the sine of the slant.
  constexpr double edge = 1e-6;
  clear = std::min({std::abs(u), std::abs(v), std::abs(1.0 - u - v)}) > edge;
  const bool inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0;
  return inside ? t : std::numeric_limits<double>::quiet_NaN();
}

// Rays that pass a triangle's border, or a curved patch's, by less than the motion, inside or
// outside, are undecidable, whatever is hit behind it; those that pass by more are not.
TEST(Oracle, DoubtsWhatPassesABorderByLessThanTheMotion) {
  constexpr double motion = 1e-7;
  const dvec3 up(0.0, 0.0, 1.0);
  const dvec3 behind(0.0, 0.0, -2.0);
  const std::array<dvec3, 3> corners{dvec3(-1, -1, 0), dvec3(1, -1, 0), dvec3(0, 1, 0)};
  for (const uint surface : {SURFACE_FLAT, SURFACE_PHONG, SURFACE_SPHERE}) {
    // All normals alike, so that borders are straight. The second triangle is larger.
    BakedScene scene;
    scene.choice = {surface, 0.65, SHELL_NORMAL};
    for (const double size : {1.0, 3.0}) {
      std::array<dvec3, 3> positions{};
      for (std::size_t k = 0; k < 3; ++k) {
        positions[k] = size * corners[k] + (size > 1.0 ? behind : dvec3(0.0));
      }
      scene.triangles.push_back(bake_triangle(positions, {up, up, up}, scene.choice));
    }
    const Oracle oracle(scene);
    // At right angles to each edge, by so much beyond it.
    for (std::size_t k = 0; k < 3; ++k) {
      const dvec3 edge = glm::normalize(corners[(k + 1) % 3] - corners[k]);
      const dvec3 outward(edge.y, -edge.x, 0.0);
      const dvec3 on_edge = glm::mix(corners[k], corners[(k + 1) % 3], 0.3);
      for (const double beyond : {0.0, 1e-9, 1e-8, 3e-8, 8e-8, 2e-7, 9e-7, 2e-6, 1e-4}) {
        for (const double sign : {-1.0, 1.0}) {
          const OracleRay ray{on_edge + outward * (sign * beyond) + up * 3.0, -up};
          const OracleAnswer answer = oracle.first(ray, motion);
          EXPECT_TRUE(answer.hit);
          EXPECT_EQ(answer.decidable, beyond > motion) << surface << k << ", " << sign * beyond;
          if (beyond > motion) {
            EXPECT_EQ(answer.root.triangle, sign > 0.0 ? 1U : 0U);
          }
        }
      }
    }
  }
}

// The same for rays around the tip of a needle, to which hardly any direction leads.
TEST(Oracle, DoubtsWhatPassesASharpCornerByLessThanTheMotion) {
  constexpr double motion = 1e-7;
  const dvec3 up(0.0, 0.0, 1.0);
  for (const uint surface : {SURFACE_FLAT, SURFACE_PHONG, SURFACE_SPHERE}) {
    BakedScene scene;
    scene.choice = {surface, 0.65, SHELL_NORMAL};
    // 3 degrees about a direction that is none of the oracle's.
    scene.triangles.push_back(bake_triangle(
        {dvec3(0.0), dvec3(1.0, 0.60, 0.0), dvec3(1.0, 0.67, 0.0)}, {up, up, up}, scene.choice));
    const Oracle oracle(scene);
    for (int k = 0; k < 16; ++k) {
      const double angle = k * 0.39269908169872414;
      const dvec3 around(std::cos(angle), std::sin(angle), 0.0);
      for (const double beyond : {1e-9, 1e-8, 9e-8}) {
        const OracleAnswer answer = oracle.first({around * beyond + up, -up}, motion);
        EXPECT_FALSE(answer.decidable) << surface << ", " << k << ", " << beyond;
      }
      // Away from the needle.
      if (around.x > 0.0) continue;
      const OracleAnswer answer = oracle.first({around * 3e-7 + up, -up}, motion);
      EXPECT_TRUE(answer.decidable && !answer.hit) << surface << ", " << k;
    }
  }
}

// 0.65 is not a number of single precision: the surfaces of the two alphas are 1e-8 apart.
TEST(Oracle, TakesAlphaAsTheKernelsDo) {
  std::mt19937_64 random(3);
  const test::RandomPatch patch = test::random_patch(random, 40.0);
  for (const uint shell : {SHELL_NORMAL, SHELL_HEIGHT}) {
    BakedScene scene = scene_of({patch}, {SURFACE_PHONG, 0.65, shell});
    const Oracle oracle(scene);
    scene.choice.alpha = static_cast<double>(0.65F);
    const Oracle single(scene);
    std::size_t met = 0;
    for (int k = 0; k < 50; ++k) {
      const dvec3 middle =
          (patch.positions[0] + patch.positions[1] + patch.positions[2]) * (1.0 / 3.0);
      const OracleRay ray = random_ray_at(middle, 3.0, random);
      const std::vector<OracleRoot> a = oracle.roots(ray);
      const std::vector<OracleRoot> b = single.roots(ray);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].t, b[i].t);
      met += a.size();
    }
    EXPECT_GT(met, 10U);
  }
}

// The points where a ray meets the patch drawn as n^2 flat triangles.
struct BruteForce {
  std::vector<double> t;
  bool clear = true;  // no triangle is met near the patch's border or edge-on
};

BruteForce brute_force(const in_double::Shape& shape, const in_double::Triangle& tri,
                       const OracleRay& ray, int n) {
  const auto point = [&](int i, int j) {
    return in_double::surface_point(shape, tri, dvec3(n - i - j, i, j) / static_cast<double>(n));
  };
  BruteForce result;
  const auto meet = [&](const dvec3& a, const dvec3& b, const dvec3& c, bool border) {
    bool inner = true;
    const double t = meet_triangle(ray, a, b, c, inner);
    const dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
    // Nearly edge-on triangles hide pairs of roots between the samples, also where they are passed
    // by within their own size.
    const double slant = std::abs(glm::dot(ray.direction, normal));
    const double distance = glm::length(glm::cross(a - ray.origin, ray.direction));
    const double size = glm::distance(a, b) + glm::distance(a, c);
    if (distance < 2.0 * size && (slant < 0.1 || border)) result.clear = false;
    if (!std::isnan(t)) {
      result.t.push_back(t);
      result.clear = result.clear && inner;
    }
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      const bool last = i + j + 1 == n;
      meet(point(i, j), point(i + 1, j), point(i, j + 1), i == 0 || j == 0 || last);
      if (!last) meet(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1), false);
    }
  }
  std::sort(result.t.begin(), result.t.end());
  return result;
}

// Both roots on the unit sphere of the line, or none.
std::vector<double> sphere_roots(const OracleRay& ray) {
  const double b = glm::dot(ray.origin, ray.direction);
  const double discriminant = b * b - glm::dot(ray.origin, ray.origin) + 1.0;
  if (discriminant < 0.0) return {};
  std::vector<double> roots;
  for (const double sign : {-1.0, 1.0}) {
    const double t = -b + sign * std::sqrt(discriminant);
    if (t >= ray.t_min) roots.push_back(t);
  }
  return roots;
}

// Both triangles have the root on an edge that they share.
std::vector<OracleRoot> without_twins(std::vector<OracleRoot> roots) {
  const auto twins = [](const OracleRoot& a, const OracleRoot& b) {
    return a.triangle != b.triangle && std::abs(a.t - b.t) < kBakedRounding;
  };
  roots.erase(std::unique(roots.begin(), roots.end(), twins), roots.end());
  return roots;
}

TEST(Oracle, FindsTheSphereOnItsTriangles) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> distance(0.0, 1.2);
  for (const std::string name : {"sphere-20", "sphere-80"}) {
    for (const uint shell : {SHELL_HEIGHT, SHELL_NORMAL}) {
      const Oracle oracle(bake(test::load_asset(name), {SURFACE_SPHERE, 0.0, shell}));
      for (int i = 0; i < 300; ++i) {
        const bool inside = i % 3 == 0;
        // Rays start in the middle half of the ball, or outside; some of those miss the sphere.
        const double r = distance(random);
        const OracleRay ray = random_ray_at(random_direction(random) * (inside ? 0.5 * r : r),
                                            inside ? 0.0 : 3.0, random);
        const dvec3 nearest = ray.origin - ray.direction * glm::dot(ray.origin, ray.direction);
        // Nearer to the silhouette the rounding of the data is magnified, or decides.
        if (std::abs(glm::length(nearest) - 1.0) < 1e-2) continue;
        const std::vector<double> expected = sphere_roots(ray);
        const std::vector<OracleRoot> roots = without_twins(oracle.roots(ray));
        ASSERT_EQ(roots.size(), expected.size()) << name << " shell " << shell << " ray " << i;
        for (std::size_t k = 0; k < roots.size(); ++k) {
          const double slant = std::abs(glm::dot(roots[k].normal, ray.direction));
          EXPECT_NEAR(roots[k].t, expected[k], kBakedRounding / slant);
          // The normal is a derivative: the data's rounding over the curvature's length, 1.
          EXPECT_NEAR(std::abs(glm::dot(roots[k].normal, ray.origin + ray.direction * roots[k].t)),
                      1.0, kBakedRounding);
        }
      }
    }
  }
}

TEST(Oracle, AgreesWithBruteForceOnCurvedPatches) {
  std::mt19937_64 random(2);
  int compared = 0;
  for (const SurfaceChoice& choice : {SurfaceChoice{SURFACE_PHONG, 1.5, SHELL_NORMAL},
                                      SurfaceChoice{SURFACE_PHONG, 1.5, SHELL_HEIGHT},
                                      SurfaceChoice{SURFACE_SPHERE, 0.0, SHELL_NORMAL},
                                      SurfaceChoice{SURFACE_SPHERE, 0.0, SHELL_HEIGHT}}) {
    for (int i = 0; i < 15; ++i) {
      const BakedScene scene = scene_of({test::random_patch(random, 60.0)}, choice);
      const in_double::Triangle tri = to_double(scene.triangles[0]);
      const Oracle oracle(scene);
      for (int k = 0; k < 4; ++k) {
        const dvec3 target = in_double::surface_point(shape_of(with_single_alpha(choice)), tri,
                                                      dvec3(0.3, 0.25, 0.45));
        const OracleRay ray = random_ray_at(target + random_direction(random) * 0.05, 4.0, random);
        const BruteForce brute = brute_force(shape_of(with_single_alpha(choice)), tri, ray, 150);
        if (!brute.clear) continue;
        const std::vector<OracleRoot> roots = oracle.roots_of(0, ray);
        ASSERT_EQ(roots.size(), brute.t.size())
            << "surface " << choice.surface << " shell " << choice.shell << " patch " << i;
        ++compared;
        for (std::size_t r = 0; r < roots.size(); ++r) {
          // The sagitta of a 150th of an edge of about 1, over the least slant of 0.1.
          EXPECT_NEAR(roots[r].t, brute.t[r], 5e-3);
        }
      }
    }
  }
  // Enough of them for the test to say something.
  EXPECT_GT(compared, 80);
}

TEST(Oracle, AgreesWithMoellerAndTrumboreOnFlatTriangles) {
  std::mt19937_64 random(3);
  const BakedScene scene = bake(test::load_asset("teapot"), {SURFACE_FLAT, 0.0});
  const Oracle oracle(scene);
  for (int i = 0; i < 500; ++i) {
    const OracleRay ray =
        random_ray_at(random_direction(random) * 0.3 * scene.extent, 3.0 * scene.extent, random);
    std::vector<double> expected;
    bool all_clear = true;
    for (const Triangle& tri : scene.triangles) {
      bool clear = true;
      const double t = meet_triangle(ray, dvec3(tri.Position[0]), dvec3(tri.Position[1]),
                                     dvec3(tri.Position[2]), clear);
      if (!std::isnan(t)) expected.push_back(t);
      all_clear = all_clear && (clear || std::isnan(t));
    }
    if (!all_clear) continue;
    std::sort(expected.begin(), expected.end());
    const std::vector<OracleRoot> roots = oracle.roots(ray);
    ASSERT_EQ(roots.size(), expected.size()) << "ray " << i;
    for (std::size_t k = 0; k < roots.size(); ++k) {
      // Roundings of coordinates of some units over a slant of 1e-3.
      EXPECT_NEAR(roots[k].t, expected[k], 1e-11 * scene.extent);
    }
  }
}

// A line at this distance from the middle of a sphere about the origin.
OracleRay ray_beside_center(double distance) {
  const dvec3 direction = glm::normalize(dvec3(0.3, -0.2, 1.0));
  const dvec3 up = glm::normalize(glm::cross(direction, dvec3(0.4, 1.0, 0.1)));
  return {up * distance - direction * 3.0, direction};
}

// The distance at which such a line touches the silhouette, by bisection on whether there is a
// root.
double silhouette(const Oracle& oracle) {
  double hits = 0.5;
  double misses = 1.5;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (hits + misses);
    (oracle.roots(ray_beside_center(middle)).empty() ? misses : hits) = middle;
  }
  return hits;
}

TEST(Oracle, CannotTellASilhouetteWithinTheMotion) {
  constexpr double motion = 1e-7;
  for (const uint surface : {SURFACE_PHONG, SURFACE_SPHERE}) {
    const Oracle oracle(bake(test::load_asset("sphere-80"), {surface, 0.65}));
    const double radius = silhouette(oracle);
    for (const double height : {-1e-9, 1e-9}) {
      const OracleAnswer answer = oracle.first(ray_beside_center(radius + height), motion);
      EXPECT_EQ(answer.hit, height < 0.0);
      EXPECT_FALSE(answer.decidable) << "surface " << surface << " height " << height;
    }
    for (const double height : {-1e-3, 1e-3}) {
      const OracleAnswer answer = oracle.first(ray_beside_center(radius + height), motion);
      EXPECT_EQ(answer.hit, height < 0.0);
      EXPECT_TRUE(answer.decidable) << "surface " << surface << " height " << height;
    }
    // Just inside the silhouette the two roots are apart by the root of the height.
    EXPECT_GE(oracle.roots(ray_beside_center(radius - 1e-9)).size(), 2U);
  }
}

// Two triangles about the edge from (0, -1, 0) to (0, 1, 0), bent like a roof.
std::vector<test::RandomPatch> roof() {
  const dvec3 a(0, -1, 0);
  const dvec3 b(0, 1, 0);
  const dvec3 na = glm::normalize(dvec3(0.1, -0.3, 1));
  const dvec3 nb = glm::normalize(dvec3(-0.1, 0.4, 1));
  return {{{a, b, dvec3(-1, 0, -0.3)}, {na, nb, glm::normalize(dvec3(-0.5, 0, 1))}},
          {{a, dvec3(1, 0, -0.4), b}, {na, glm::normalize(dvec3(0.6, 0, 1)), nb}}};
}

TEST(Oracle, DecidesARayThroughASharedEdgeOfTheNormalShell) {
  for (const uint surface : {SURFACE_PHONG, SURFACE_SPHERE}) {
    const SurfaceChoice choice{surface, 0.65, SHELL_NORMAL};
    const BakedScene scene = scene_of(roof(), choice);
    const Oracle oracle(scene);
    const dvec3 on_edge = in_double::surface_point(
        shape_of(with_single_alpha(choice)), to_double(scene.triangles[0]), dvec3(0.375, 0.625, 0));
    const dvec3 direction = glm::normalize(dvec3(0.1, 0.05, -1));
    const OracleRay ray{on_edge - direction * 2.0, direction};
    const std::vector<OracleRoot> roots = oracle.roots(ray);
    ASSERT_EQ(roots.size(), 2U);
    // Both faces, the same point, to roundings of numbers near 2; the sphere surface to the
    // rounding of each face's own angle to float, times the difference of curvatures and the
    // sagitta.
    const double rounding = surface == SURFACE_PHONG ? 1e-12 : 1e-8;
    EXPECT_NE(roots[0].triangle, roots[1].triangle);
    EXPECT_NEAR(roots[0].t, 2.0, rounding);
    EXPECT_NEAR(roots[1].t, 2.0, rounding);
    EXPECT_TRUE(oracle.first(ray, 1e-7).decidable);
  }
}

TEST(Oracle, CannotTellARayAtAnOpenEdge) {
  const Oracle oracle(scene_of(roof(), {SURFACE_PHONG, 0.65, SHELL_NORMAL}));
  const in_double::Triangle tri =
      to_double(scene_of(roof(), {SURFACE_PHONG, 0.65, SHELL_NORMAL}).triangles[0]);
  const dvec3 border =
      in_double::surface_point({SURFACE_PHONG, SHELL_NORMAL, 0.65}, tri, dvec3(0.375, 0, 0.625));
  const dvec3 outward = glm::normalize(dvec3(-1, -1, 0));
  const auto answer = [&](double height) {
    return oracle.first({border + outward * height + dvec3(0, 0, 2), dvec3(0, 0, -1)}, 1e-7);
  };
  for (const double near : {-2e-8, 2e-8}) EXPECT_FALSE(answer(near).decidable) << near;
  for (const double far : {-1e-4, 1e-4}) EXPECT_TRUE(answer(far).decidable) << far;
  EXPECT_TRUE(answer(-1e-4).hit);
  EXPECT_FALSE(answer(1e-4).hit);
}

TEST(Oracle, CannotTellWhetherARootLiesBeforeTheStart) {
  const Oracle oracle(scene_of(roof(), {SURFACE_FLAT, 0.0}));
  OracleRay ray{dvec3(-0.4, 0.1, 1), dvec3(0, 0, -1)};
  const double t = oracle.roots(ray).at(0).t;
  ray.t_min = t + 1e-8;
  EXPECT_FALSE(oracle.first(ray, 1e-7).hit);
  EXPECT_FALSE(oracle.first(ray, 1e-7).decidable);
  ray.t_min = t + 1e-3;
  EXPECT_FALSE(oracle.first(ray, 1e-7).hit);
  EXPECT_TRUE(oracle.first(ray, 1e-7).decidable);
}

TEST(Oracle, FindsThreeRootsOnAnSShapedPatch) {
  // In the normal shell the edge 01 is displaced along w_0 N_0 + w_1 N_1: opposite normals, an S.
  const dvec3 leaning = glm::normalize(dvec3(0.5, 0, 1));
  const SurfaceChoice choice{SURFACE_PHONG, 3.0, SHELL_NORMAL};
  const BakedScene scene = scene_of(
      {{{dvec3(-1, 0, 0), dvec3(1, 0, 0), dvec3(0, 1, 0)}, {leaning, -leaning, dvec3(0, 0, 1)}}},
      choice);
  const Oracle oracle(scene);
  const in_double::Triangle tri = to_double(scene.triangles[0]);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> near(-0.02, 0.02);
  int three = 0;
  for (int i = 0; i < 60; ++i) {
    // Almost along the edge, beside it, less steep than the S in its middle and steeper than at its
    // ends.
    const dvec3 direction = glm::normalize(dvec3(1, near(random), 0.3 + near(random)));
    const dvec3 target(near(random), 0.05 + near(random), near(random));
    const OracleRay ray{target - direction * 4.0, direction};
    const BruteForce brute = brute_force(shape_of(with_single_alpha(choice)), tri, ray, 150);
    // None of these rays grazes the patch or its border, though `clear` is too strict to say so.
    const std::vector<OracleRoot> roots = oracle.roots_of(0, ray);
    ASSERT_EQ(roots.size(), brute.t.size()) << "ray " << i;
    three += roots.size() == 3 ? 1 : 0;
    for (std::size_t r = 0; r < roots.size(); ++r) {
      // The sagitta of a 150th of a curve of height 0.5, over the slant of some 0.2.
      EXPECT_NEAR(roots[r].t, brute.t[r], 2e-3);
    }
  }
  EXPECT_EQ(three, 60);
}

TEST(Oracle, YieldsNoNanForNormalsAtRightAnglesOrBehind) {
  std::mt19937_64 random(6);
  const std::array<dvec3, 3> corners{dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(0, 1, 0)};
  const std::vector<std::array<dvec3, 3>> normals{
      {dvec3(1, 0, 0), dvec3(0, 0, 1), dvec3(0, 0, 1)},
      {dvec3(0, 0, -1), dvec3(0, 0, 1), dvec3(0, 0, 1)},
      {dvec3(0, 0, -1), dvec3(0, 0, -1), dvec3(0, 0, -1)},
      {glm::normalize(dvec3(1, 0, 1e-6)), dvec3(0, 0, 1), dvec3(0, 0, 1)}};
  for (const uint shell : {SHELL_HEIGHT, SHELL_NORMAL}) {
    for (const uint surface : {SURFACE_FLAT, SURFACE_PHONG, SURFACE_SPHERE}) {
      for (const std::array<dvec3, 3>& n : normals) {
        const Oracle oracle(scene_of({{corners, n}}, {surface, 0.65, shell}));
        for (int i = 0; i < 6; ++i) {
          const OracleRay ray = random_ray_at(dvec3(0.3, 0.3, 0.0), 3.0, random);
          const std::vector<OracleRoot> roots = oracle.roots(ray);
          if (surface == SURFACE_FLAT) {
            EXPECT_EQ(roots.size(), 1U);
          }
          for (const OracleRoot& root : roots) {
            EXPECT_TRUE(std::isfinite(root.t));
            // Unit to rounding; false for NaN.
            EXPECT_NEAR(glm::length(root.normal), 1.0, 1e-12);
            EXPECT_NEAR(root.weights.x + root.weights.y + root.weights.z, 1.0, 1e-12);
          }
        }
      }
    }
  }
}

OracleRay pixel_ray(uint32_t x, uint32_t y) {
  return {dvec3(0, 0, 4),
          glm::normalize(dvec3((x + 0.5) / 32.0 - 0.5, (y + 0.5) / 24.0 - 0.5, -1.5))};
}

TEST(OracleFrame, EqualsSingleRays) {
  const Oracle oracle(bake(test::load_asset("sphere-20"), {}));
  const auto motion = [](const OracleRay&) { return 1e-4; };
  uint32_t rows = 0;
  const auto count = [&](uint32_t done) {
    rows = done;
    return true;
  };
  const OracleFrame frame = oracle_frame(oracle, 32, 24, pixel_ray, motion, count).value();
  EXPECT_EQ(rows, 24U);
  ASSERT_EQ(frame.pixels.size(), 32U * 24U);
  int hits = 0;
  for (uint32_t y = 0; y < 24; ++y) {
    for (uint32_t x = 0; x < 32; ++x) {
      const OracleAnswer expected = oracle.first(pixel_ray(x, y), 1e-4);
      const OracleAnswer& pixel = frame.pixels[std::size_t{y} * 32 + x];
      EXPECT_EQ(pixel.hit, expected.hit);
      EXPECT_EQ(pixel.decidable, expected.decidable);
      EXPECT_EQ(pixel.root.t, expected.root.t);
      EXPECT_EQ(pixel.root.triangle, expected.root.triangle);
      hits += pixel.hit ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 100);
}

TEST(OracleFrame, StopsWhenProgressSaysSoOrARayThrows) {
  const Oracle oracle(bake(test::load_asset("sphere-20"), {}));
  const auto motion = [](const OracleRay&) { return 1e-6; };
  std::atomic<uint32_t> last_row = 0;
  const auto ray = [&](uint32_t x, uint32_t y) {
    last_row = y;
    return pixel_ray(x % 32, y % 24);
  };
  // 3,000,000 rows would take minutes.
  const auto stop = [](uint32_t) { return false; };
  EXPECT_FALSE(oracle_frame(oracle, 1, 3'000'000, ray, motion, stop));
  EXPECT_LT(last_row, 2'900'000U);
  const auto interrupt = [](uint32_t) -> bool { throw std::runtime_error("interrupted"); };
  EXPECT_THROW(oracle_frame(oracle, 1, 3'000'000, ray, motion, interrupt), std::runtime_error);
  const auto broken = [](uint32_t, uint32_t) -> OracleRay { throw std::out_of_range("ray"); };
  EXPECT_THROW(oracle_frame(oracle, 8, 8, broken, motion, {}), std::out_of_range);
}

}  // namespace
}  // namespace trisect
