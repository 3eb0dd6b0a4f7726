// What the kernels prove of nonsmooth subpatches while they search them: ranges of sigma, and fits
// of nodes.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "app/base/interval.h"
#include "app/dispatch/kernel_float.h"
#include "app/stress/stress_scenes.h"
#include "app/surface/control_net.h"
#include "app/surface/surface_double.h"
#include "app/surface/to_double.h"
#include "tests/support/baked_models.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

// The kernel's bounds for nonsmooth subpatches, over nodes of all sizes; of others, too, for which
// they hold as well.
TEST(SphereRange, HoldsSigmaAndItsChanges) {
  std::mt19937_64 random(6);
  double widths = 0.0;
  double seen = 0.0;
  std::size_t nodes = 0;
  std::size_t of_known_gradient = 0;
  for (const test::BakedModel& model :
       {test::BakedModel{"wild", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}},
        test::BakedModel{"teapot", {SURFACE_SPHERE, 0.0, SHELL_HEIGHT}}}) {
    const bool wild = std::string(model.name) == "wild";
    const BakedScene scene = test::baked(model);
    const in_float::Shape single_shape{SURFACE_SPHERE, model.choice.shell, 0.0F};
    const in_double::Shape shape = shape_of(scene.choice);
    for (const SubpatchBounds& bounds : scene.subpatches) {
      if (bounds.skip > 0) continue;
      if (bounds.gradient_lipschitz != NONSMOOTH && random() % 4 != 0) continue;
      const Triangle& single = scene.triangles[bounds.triangle];
      const in_double::Triangle tri = to_double(single);
      uint path = in_float::WHOLE;
      for (int level = 0; level < 9; ++level, path = path << 2U | (random() & 3U)) {
        const in_float::SubTriangle node =
            in_float::with_overlap(in_float::sub_triangle_at(bounds.sub_triangle, path));
        const auto over = in_float::sphere_node(single_shape, single, node);
        const in_float::SphereRange range = in_float::sphere_range(single_shape, single, over);
        ++nodes;
        if (range.u.hi < in_float::UNBOUNDED) ++of_known_gradient;
        double lo = 1e30;
        double hi = -1e30;
        dvec3 before = dvec3(node.origin) + dvec3(double{node.size} / 3.0);
        double sigma_before = in_double::displacement(shape, tri, before);
        for (int i = 0; i < 10; ++i) {
          const dvec3 w = dvec3(node.origin) + test::random_weights(random) * double{node.size};
          const double sigma = in_double::displacement(shape, tri, w);
          lo = std::min(lo, sigma);
          hi = std::max(hi, sigma);
          const Interval change = Interval(range.u.lo, range.u.hi) * (w.y - before.y) +
                                  Interval(range.v.lo, range.v.hi) * (w.z - before.z);
          constexpr double rounding = 1e-14;
          ASSERT_LE(change.lo, sigma - sigma_before + rounding)
              << "triangle " << bounds.triangle << " level " << level;
          ASSERT_GE(change.hi, sigma - sigma_before - rounding)
              << "triangle " << bounds.triangle << " level " << level;
          before = w;
          sigma_before = sigma;
        }
        ASSERT_LE(range.s.lo, lo) << "triangle " << bounds.triangle << " level " << level;
        ASSERT_GE(range.s.hi, hi) << "triangle " << bounds.triangle << " level " << level;
        // Where directions nearly vanish sigma, in units of them, has no telling size.
        if (wild) continue;
        widths += static_cast<double>(range.s.hi) - range.s.lo;
        seen += hi - lo;
      }
    }
  }
  EXPECT_GT(seen, 100.0);
  // Interval arithmetic overestimates, and ten points do not show the whole range; but not by more.
  EXPECT_LT(widths, 10.0 * seen);
  // About a vertex whose height leaves the definition the gradient is not bounded.
  EXPECT_GT(of_known_gradient, nodes * 9 / 10);
}

// Their fits: a ray through a point of the node overlaps it, and S and its tangents are no farther
// from those of T + q D than the fit's errors.
TEST(SphereRange, FitsTheNodesOfNonsmoothSubpatches) {
  std::mt19937_64 random(8);
  const BakedScene scene = test::baked({"wild", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}});
  const in_float::Shape single_shape{SURFACE_SPHERE, SHELL_NORMAL, 0.0F};
  const in_double::Shape shape = shape_of(scene.choice);
  std::size_t of_known_gradient = 0;
  std::size_t of_unknown_gradient = 0;
  for (const SubpatchBounds& bounds : scene.subpatches) {
    if (bounds.gradient_lipschitz != NONSMOOTH || bounds.skip > 0) continue;
    const Triangle& single = scene.triangles[bounds.triangle];
    const in_double::Triangle tri = to_double(single);
    const Patch corners = patch_of(shape.shell, single);
    uint path = in_float::WHOLE;
    for (int level = 0; level < 6; ++level, path = path << 2U | (random() & 3U)) {
      const in_float::SubTriangle node =
          in_float::with_overlap(in_float::sub_triangle_at(bounds.sub_triangle, path));
      for (int i = 0; i < 6; ++i) {
        // Three corners of the node and three points within it.
        dvec3 l = test::random_weights(random);
        if (i < 3) {
          l = dvec3(0.0);
          l[i] = 1.0;
        }
        const dvec3 w = dvec3(node.origin) + l * double{node.size};
        const dvec3 S = in_double::surface_point(shape, tri, w);
        const dvec3 view = stress::any_direction(random);
        const in_float::RayFrame frame =
            in_float::ray_frame(glm::vec3(S - view * scene.radius), glm::vec3(view));
        in_float::Fit fit{};
        uint evaluations = 0;
        ASSERT_TRUE(in_float::ranged_fit(
            single_shape, single,
            in_float::sheared_patch(frame, in_float::rotated_patch(frame, SHELL_NORMAL, single)),
            node, in_float::position_tolerance(frame, single), fit, evaluations))
            << "triangle " << bounds.triangle << " level " << level << " point " << i;
        const test::QuadraticErrors errors =
            test::errors_of({dvec3(fit.corner), dvec3(fit.edge)}, shape, tri, corners, w);
        // What rounds in sigma itself.
        constexpr double rounding = 1e-6;
        ASSERT_LE(errors.position, fit.position_error + rounding * scene.radius)
            << "triangle " << bounds.triangle << " level " << level;
        if (fit.tangent_error >= in_float::UNBOUNDED) {
          ++of_unknown_gradient;
          continue;
        }
        ++of_known_gradient;
        ASSERT_LE(errors.tangents, fit.tangent_error + rounding * scene.radius)
            << "triangle " << bounds.triangle << " level " << level;
      }
    }
  }
  EXPECT_GT(of_known_gradient, 10000U);
  EXPECT_GT(of_unknown_gradient, 1000U);
}

}  // namespace
}  // namespace trisect
