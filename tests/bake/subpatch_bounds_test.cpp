// The bounds of subpatches and their projections, against points of the surface.
#include "app/bake/subpatch_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "app/bake/subpatch_boxes.h"
#include "app/bake/subpatch_fit.h"
#include "app/base/interval.h"
#include "app/dispatch/kernel_float.h"
#include "app/dispatch/trace_settings.h"
#include "app/stress/stress_scenes.h"
#include "app/surface/control_net.h"
#include "app/surface/surface_double.h"
#include "app/surface/to_double.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

struct Choice {
  const char* model;
  SurfaceChoice choice;
};

const Choice kChoices[] = {{"sphere-20", {SURFACE_PHONG, 0.65, SHELL_NORMAL}},
                           {"saddle", {SURFACE_PHONG, 1.0, SHELL_NORMAL}},
                           {"teapot", {SURFACE_PHONG, 0.65, SHELL_NORMAL}},
                           {"relief", {SURFACE_PHONG, 0.65, SHELL_HEIGHT}},
                           {"sphere-80", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}}};

// Of an asset or, "wild", of patches with steep normals.
BakedScene baked(const Choice& choice) {
  const bool wild = std::string(choice.model) == "wild";
  return bake_with_subpatches(wild ? test::wild_patches(80) : test::load_asset(choice.model),
                              choice.choice);
}

dvec3 weights_of(const SubpatchBounds& bounds, const dvec3& l) {
  return dvec3(bounds.sub_triangle) + l * static_cast<double>(bounds.sub_triangle.w);
}

in_double::SubTriangle sub_triangle_of(const SubpatchBounds& bounds) {
  return {dvec3(bounds.sub_triangle), double{bounds.sub_triangle.w}};
}

DisplacementQuadratic quadratic_of(const SubpatchBounds& bounds) {
  return {dvec3(glm::vec3(bounds.corner)), dvec3(glm::vec3(bounds.edge))};
}

// The control points of a subpatch with its overlap.
std::array<dvec3, 10> control_points_of(const BakedScene& scene, const SubpatchBounds& bounds) {
  return control_points(patch_of(scene.choice.shell, scene.triangles[bounds.triangle]),
                        quadratic_of(bounds), in_double::with_overlap(sub_triangle_of(bounds)));
}

// Directions on the border of a subpatch's cone, all around its axis.
std::array<dvec3, 16> cone_border(const SubpatchBounds& bounds) {
  const dvec3 n(bounds.cone);
  const dvec3 x = glm::normalize(std::abs(n.x) < 0.5 ? glm::cross(n, {1.0, 0.0, 0.0})
                                                     : glm::cross(n, {0.0, 1.0, 0.0}));
  const dvec3 y = glm::cross(n, x);
  const double cosine = bounds.cone.w;
  const double sine = std::sqrt(1.0 - cosine * cosine);
  std::array<dvec3, 16> border{};
  for (std::size_t k = 0; k < border.size(); ++k) {
    const double angle = static_cast<double>(k) * std::acos(-1.0) / 8.0;
    border[k] = n * cosine + (x * std::cos(angle) + y * std::sin(angle)) * sine;
  }
  return border;
}

// No line within a subpatch's cone is tangent to the enlarged subpatch: S_u, S_v and the line keep
// their orientation.
TEST(SubpatchBounds, LinesWithinItsConeCrossTheSubpatchOneWay) {
  std::size_t cones = 0;
  for (const Choice& choice : kChoices) {
    const BakedScene scene = baked(choice);
    for (const SubpatchBounds& bounds : scene.subpatches) {
      if (bounds.cone.w == NO_CONE) continue;
      ++cones;
      const in_double::Triangle tri = to_double(scene.triangles[bounds.triangle]);
      const in_double::Shape shape = shape_of(choice.choice);
      const std::array<dvec3, 16> border = cone_border(bounds);
      for (const dvec3& l : test::weight_grid(6)) {
        const dvec3 w =
            weights_of(bounds, l * (1.0 + 3.0 * CONE_MARGIN) - dvec3(double{CONE_MARGIN}));
        const dvec3 normal = in_double::geometric_normal(shape, tri, w);
        const double side = glm::dot(normal, dvec3(bounds.cone));
        for (const dvec3& d : border) {
          ASSERT_GT(glm::dot(normal, d) * side, 0.0)
              << choice.model << " triangle " << bounds.triangle;
        }
      }
    }
  }
  EXPECT_GT(cones, 1000U);
}

// Nor is any surface whose tangents are off those of the quadratic by the tangent error, each pair
// of them by the worst that there is for lines on the cone's border.
TEST(SubpatchBounds, LinesWithinItsConeCrossWhateverIsWithinTheTangentError) {
  std::size_t cones = 0;
  const Choice choice{"teapot", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}};
  const BakedScene scene = baked(choice);
  for (const SubpatchBounds& bounds : scene.subpatches) {
    if (bounds.cone.w == NO_CONE) continue;
    ++cones;
    const in_double::SubTriangle large =
        in_double::enlarged(sub_triangle_of(bounds), double{CONE_MARGIN});
    const auto [u, v] = tangent_net(patch_of(choice.choice.shell, scene.triangles[bounds.triangle]),
                                    quadratic_of(bounds), large);
    const double error = double{bounds.edge.w} * std::abs(large.size) / 3.0;
    const dvec3 n(bounds.cone);
    for (const dvec3& d : cone_border(bounds)) {
      for (std::size_t i = 0; i < 6; ++i) {
        // The volume of u, v and d is linear in either of the tangents: each is moved against its
        // gradient, as far as it may be.
        const double whole = glm::dot(glm::cross(u[i], v[i]), d);
        const double side = whole * glm::dot(glm::cross(u[0], v[0]), n) > 0.0 ? 1.0 : -1.0;
        dvec3 moved_u = u[i];
        dvec3 moved_v = v[i];
        for (int step = 0; step < 4; ++step) {
          moved_u = u[i] - glm::normalize(glm::cross(moved_v, d)) * (side * error);
          moved_v = v[i] - glm::normalize(glm::cross(d, moved_u)) * (side * error);
        }
        const double room = glm::dot(glm::cross(moved_u, moved_v), d) / whole;
        ASSERT_GT(room, 0.0) << "triangle " << bounds.triangle;
      }
    }
  }
  EXPECT_GT(cones, 1000U);
}

// How far S and its tangents are from those of T + q D at weights w.
struct QuadraticErrors {
  double position;
  double tangents;
};
QuadraticErrors errors_of(const DisplacementQuadratic& q, const in_double::Shape& shape,
                          const in_double::Triangle& tri, const Patch& corners, const dvec3& w) {
  const in_double::Displacement sigma = in_double::displacement_and_derivatives(shape, tri, w);
  const dvec3 D = in_double::shell_direction(shape.shell, tri, w);
  const double e = sigma.s - q.blossom(w, w);
  const double off_u = sigma.u - 2.0 * q.blossom(w, {-1.0, 1.0, 0.0});
  const double off_v = sigma.v - 2.0 * q.blossom(w, {-1.0, 0.0, 1.0});
  return {std::abs(e) * glm::length(D),
          std::max(glm::length(D * off_u + (corners.D[1] - corners.D[0]) * e),
                   glm::length(D * off_v + (corners.D[2] - corners.D[0]) * e))};
}

// Points of a subpatch and of its overlap: the surface and its tangents differ from those of T + q
// D by no more than the errors, and the surface lies in the ball.
TEST(SubpatchBounds, HoldTheSurface) {
  std::mt19937_64 random(5);
  std::size_t nonsmooth = 0;
  double most_of_position_error = 0.0;
  double most_of_tangent_error = 0.0;
  for (const Choice& choice : {Choice{"sphere-20", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}},
                               Choice{"relief", {SURFACE_SPHERE, 0.0, SHELL_HEIGHT}},
                               Choice{"saddle", {SURFACE_SPHERE, 0.0, SHELL_HEIGHT}},
                               Choice{"torus", {SURFACE_PHONG, 0.65, SHELL_HEIGHT}},
                               Choice{"teapot", {SURFACE_SPHERE, 0.0, SHELL_HEIGHT}},
                               Choice{"wild", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}}}) {
    const BakedScene scene = baked(choice);
    const in_double::Shape shape = shape_of(choice.choice);
    for (std::size_t k = 0; k < scene.subpatches.size(); ++k) {
      const SubpatchBounds& bounds = scene.subpatches[k];
      if (bounds.skip > 0) continue;
      // All that are nonsmooth, every third of the others.
      if (bounds.gradient_lipschitz == NONSMOOTH) {
        ++nonsmooth;
      } else if (k % 3 != 0) {
        continue;
      }
      const in_double::Triangle tri = to_double(scene.triangles[bounds.triangle]);
      const Patch corners = patch_of(shape.shell, scene.triangles[bounds.triangle]);
      const DisplacementQuadratic q = quadratic_of(bounds);
      for (int i = 0; i < 10; ++i) {
        const dvec3 l = test::random_weights(random);
        const dvec3 w = weights_of(bounds, l * (1.0 + 3.0 * OVERLAP) - dvec3(double{OVERLAP}));
        const QuadraticErrors errors = errors_of(q, shape, tri, corners, w);
        ASSERT_LE(errors.position, bounds.corner.w) << choice.model << " subpatch " << k;
        const dvec3 S = in_double::surface_point(shape, tri, w);
        ASSERT_LE(glm::distance(S, dvec3(bounds.ball)), bounds.ball.w)
            << choice.model << " subpatch " << k;
        if (bounds.gradient_lipschitz == NONSMOOTH) continue;
        ASSERT_LE(errors.tangents, bounds.edge.w) << choice.model << " subpatch " << k;
        most_of_position_error =
            std::max(most_of_position_error, errors.position / bounds.corner.w);
        most_of_tangent_error = std::max(most_of_tangent_error, errors.tangents / bounds.edge.w);
      }
    }
  }
  EXPECT_GT(nonsmooth, 1000U);
  // The largest difference of the bake's samples is two thirds of an error. At points between the
  // samples it is not much larger, so most of the margin is left for points that no test sees.
  EXPECT_LT(most_of_position_error, 0.75);
  EXPECT_LT(most_of_tangent_error, 0.85);
}

// What the fit is in double precision, the bounds have in single precision, rounded up.
TEST(SubpatchBounds, AreNoLessThanTheErrorsOfTheirFit) {
  const SurfaceChoice choice{SURFACE_SPHERE, 0.0, SHELL_NORMAL};
  const BakedScene scene = baked({"sphere-80", choice});
  std::size_t rounded = 0;
  for (const SubpatchBounds& bounds : scene.subpatches) {
    const Triangle& tri = scene.triangles[bounds.triangle];
    const Fit fit =
        fit_subpatch({shape_of(choice), to_double(tri), patch_of(choice.shell, tri), dvec3(0.0)},
                     sub_triangle_of(bounds));
    ASSERT_GE(double{bounds.corner.w}, fit.position_error);
    ASSERT_GE(double{bounds.edge.w}, fit.tangent_error);
    ASSERT_GE(double{bounds.gradient_lipschitz}, fit.gradient_lipschitz);
    if (double{static_cast<float>(fit.position_error)} < fit.position_error) ++rounded;
  }
  EXPECT_GT(rounded, 100U);
}

// The kernel's bounds for nonsmooth subpatches, over nodes of all sizes; of others, too, for which
// they hold as well.
TEST(SphereRange, HoldsSigmaAndItsChanges) {
  std::mt19937_64 random(6);
  double widths = 0.0;
  double seen = 0.0;
  std::size_t nodes = 0;
  std::size_t of_known_gradient = 0;
  for (const Choice& choice : {Choice{"wild", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}},
                               Choice{"teapot", {SURFACE_SPHERE, 0.0, SHELL_HEIGHT}}}) {
    const bool wild = std::string(choice.model) == "wild";
    const BakedScene scene = baked(choice);
    const in_float::Shape single_shape{SURFACE_SPHERE, choice.choice.shell, 0.0F};
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
  const BakedScene scene = baked({"wild", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}});
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
        const QuadraticErrors errors =
            errors_of({dvec3(fit.corner), dvec3(fit.edge)}, shape, tri, corners, w);
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

// Pictures for projections, and where in them a point is.
struct View {
  TraceParams params;
  in_float::Kernel kernel;

  View(const BakedScene& scene, const dvec3& eye, const dvec3& target, uint32_t width = 640,
       uint32_t height = 480)
      : params(make_params(scene, settings(eye, target, width, height))),
        kernel(in_float::kernel_of(scene, params, {})) {}

  // In pixels; z is the depth along the axis. Nothing where the point is not before the eye.
  struct Seen {
    double z;
    std::optional<glm::dvec2> pixel;
  };
  [[nodiscard]] Seen at(const dvec3& point) const {
    const dvec3 S = point - dvec3(params.anchor);
    const double z = glm::dot(S, dvec3(params.frame_z));
    const double before = 1.0 + z / params.anchor.w;
    if (before <= 1e-3) return {z, {}};
    const glm::dvec2 middle(0.5 * params.image_width, 0.5 * params.image_height);
    return {z, middle + glm::dvec2(glm::dot(S, dvec3(params.frame_x)) / params.frame_x.w,
                                   glm::dot(S, dvec3(params.frame_y)) / params.frame_y.w) /
                            before};
  }

 private:
  static TraceSettings settings(const dvec3& eye, const dvec3& target, uint32_t width,
                                uint32_t height) {
    TraceSettings settings;
    settings.width = width;
    settings.height = height;
    settings.camera.eye = eye;
    settings.camera.target = target;
    return settings;
  }
};

// The image positions of points of the surface lie in the box and within the lines of the projected
// subpatch, and their depth is not less than the one at which it begins.
TEST(ProjectedSubpatch, HoldsTheImageOfTheSurface) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::size_t points = 0;
  double tightest = 1e30;
  for (const Choice& choice : kChoices) {
    const BakedScene scene = baked(choice);
    for (int camera = 0; camera < 6; ++camera) {
      const dvec3 from(unit(random), unit(random), unit(random));
      // Every other camera is inside the model.
      const dvec3 eye = scene.origin + from * scene.radius * (camera % 2 == 0 ? 4.0 : 0.5);
      View view(scene, eye, scene.origin + dvec3(unit(random), 0.1, 0.2) * scene.radius * 0.2);
      in_float::Kernel& kernel = view.kernel;
      for (uint32_t i = 0; i < scene.subpatches.size(); i += 7) {
        const SubpatchBounds& bounds = scene.subpatches[i];
        const ProjectedSubpatch seen = kernel.project_subpatch(i);
        ProjectedSubpatch balled = seen;
        kernel.bound_by_ball(bounds.ball, balled);
        for (const dvec3& l : test::weight_grid(4)) {
          const auto [z, pixel] = view.at(in_double::surface_point(
              shape_of(choice.choice), to_double(scene.triangles[bounds.triangle]),
              weights_of(bounds, l)));
          EXPECT_GE(z, seen.lines_x.w);
          if (!pixel || std::max(std::abs(pixel->x), std::abs(pixel->y)) > 1e4) continue;
          const glm::dvec2 p = *pixel;
          ++points;
          ASSERT_TRUE(kernel.overlaps_rect(seen, glm::vec2(p), glm::vec2(kernel.PIXEL_SLACK)))
              << choice.model << " subpatch " << i << " view " << camera << " at " << p.x << ", "
              << p.y;
          ASSERT_TRUE(kernel.overlaps_rect(balled, glm::vec2(p), glm::vec2(kernel.PIXEL_SLACK)));
          EXPECT_GE(z, balled.lines_x.w);
          tightest = std::min(tightest, double{seen.box.z} - p.x);
        }
      }
    }
  }
  EXPECT_GT(points, 10000U);
  // The box is no larger than it must be.
  EXPECT_LT(tightest, 0.5);
}

// Where the model is small in a large picture, the roundings of image positions are longer than all
// tolerances of the model.
TEST(ProjectedSubpatch, HoldsTheImageOfASmallModelInALargePicture) {
  std::mt19937_64 random(5);
  const Choice choice{"sphere-320", {SURFACE_FLAT, 0.0, SHELL_NORMAL}};
  const BakedScene scene = baked(choice);
  for (int camera = 0; camera < 20; ++camera) {
    View view(scene, scene.origin + stress::any_direction(random) * scene.radius * 600.0,
              scene.origin + stress::any_direction(random) * scene.radius, kLargestSide,
              kLargestSide);
    in_float::Kernel& kernel = view.kernel;
    for (uint32_t i = 0; i < scene.subpatches.size(); ++i) {
      const SubpatchBounds& bounds = scene.subpatches[i];
      const ProjectedSubpatch seen = kernel.project_subpatch(i);
      for (const dvec3& l : test::weight_grid(4)) {
        const auto [z, pixel] = view.at(in_double::surface_point(
            shape_of(choice.choice), to_double(scene.triangles[bounds.triangle]),
            weights_of(bounds, l)));
        ASSERT_TRUE(pixel);
        ASSERT_TRUE(kernel.overlaps_rect(seen, glm::vec2(*pixel), glm::vec2(kernel.PIXEL_SLACK)))
            << "subpatch " << i << " view " << camera;
      }
    }
  }
}

// And so are the control points of its overlap, moved by the position error.
TEST(ProjectedSubpatch, HoldsTheImageOfItsControlPointsWithTheirError) {
  std::mt19937_64 random(4);
  std::size_t points = 0;
  const Choice choice{"sphere-20", {SURFACE_SPHERE, 0.0, SHELL_NORMAL}};
  const BakedScene scene = baked(choice);
  for (int camera = 0; camera < 20; ++camera) {
    View view(scene, scene.origin + stress::any_direction(random) * scene.radius * 4.0,
              scene.origin);
    in_float::Kernel& kernel = view.kernel;
    for (uint32_t i = 0; i < scene.subpatches.size(); ++i) {
      const SubpatchBounds& bounds = scene.subpatches[i];
      const ProjectedSubpatch seen = kernel.project_subpatch(i);
      for (const dvec3& point : control_points_of(scene, bounds)) {
        const auto [z, pixel] =
            view.at(point + stress::any_direction(random) * double{bounds.corner.w});
        ASSERT_GE(z, seen.lines_x.w);
        ASSERT_TRUE(pixel);
        const glm::dvec2 p = *pixel;
        ++points;
        ASSERT_TRUE(kernel.overlaps_rect(seen, glm::vec2(p), glm::vec2(kernel.PIXEL_SLACK)))
            << "subpatch " << i << " view " << camera << " at " << p.x << ", " << p.y;
      }
    }
  }
  EXPECT_GT(points, 10000U);
}

// A subpatch's box holds what its control points with their error and its ball have in common, and
// the slack for a ray's roundings around that.
TEST(SubpatchBoxes, HoldControlPointsWithTheirErrorAndTheSlack) {
  for (const Choice& choice : kChoices) {
    const BakedScene scene = baked(choice);
    const std::vector<SubpatchBox> boxes = subpatch_boxes(scene);
    const dvec3 slack(double{BVH_SLACK} * scene.radius);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const SubpatchBounds& bounds = scene.subpatches[i];
      const dvec3 error(bounds.corner.w);
      const dvec3 lowest = dvec3(bounds.ball) - dvec3(bounds.ball.w);
      const dvec3 highest = dvec3(bounds.ball) + dvec3(bounds.ball.w);
      for (const dvec3& point : control_points_of(scene, bounds)) {
        const dvec3 lo = glm::clamp(point - error, lowest, highest) - slack;
        const dvec3 hi = glm::clamp(point + error, lowest, highest) + slack;
        for (int k = 0; k < 3; ++k) {
          ASSERT_LE(double{boxes[i].lo[k]}, lo[k]) << choice.model << " subpatch " << i;
          ASSERT_GE(double{boxes[i].hi[k]}, hi[k]) << choice.model << " subpatch " << i;
        }
      }
    }
  }
}

// The bake says how many triangles are done, all of them at the end, and ends where it is told to.
TEST(SubpatchBounds, TellHowManyAreMade) {
  const Mesh mesh = test::load_asset("sphere-320");
  const SurfaceChoice choice{SURFACE_PHONG, 0.65, SHELL_NORMAL};
  std::vector<uint32_t> told;
  const auto scene = bake_with_subpatches(mesh, choice, [&](uint32_t done) {
    told.push_back(done);
    return true;
  });
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->subpatches.size(), bake_with_subpatches(mesh, choice).subpatches.size());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 320U);
  EXPECT_FALSE(bake_with_subpatches(mesh, choice, [](uint32_t) { return false; }));
}

}  // namespace
}  // namespace trisect
