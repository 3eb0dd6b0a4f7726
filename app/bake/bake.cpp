#include "app/bake/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/bake/patch_bounds.h"
#include "app/base/error.h"
#include "app/base/memory.h"
#include "app/base/parallel_rows.h"
#include "app/base/rounding.h"
#include "app/mesh/bounds.h"
#include "app/surface/patch_range.h"

namespace trisect {
namespace {

using glm::dvec3;

vec4 rounded(const dvec3& v, double w = 0.0) {
  return {glm::vec3(v), static_cast<float>(w)};
}

// Rounding to single precision can bring vertices of a very small or thin triangle together. Its
// curvatures are then held to this over its longest edge, and its angles to at least 1 over this:
// just beyond what a triangle has whose area is not lost in double precision's roundings already.
// The kernels square curvatures times lengths.
constexpr double kSteepest = 1e15;

// Curvature of the sphere through P_i with normal N_i that also passes through P_i + edge. 0 if the
// edge has no length.
double curvature(const dvec3& edge, const dvec3& normal, double longest) {
  const double square = glm::dot(edge, edge);
  if (square == 0.0) return 0.0;
  const double most = std::min(kSteepest / longest, in_double::UNBOUNDED);
  return std::clamp(-2.0 * glm::dot(edge, normal) / square, -most, most);
}

// So that the largest component is 1 and squares do not underflow; 0 stays 0.
dvec3 scaled(const dvec3& v) {
  const dvec3 size = glm::abs(v);
  const double scale = std::max({size.x, size.y, size.z});
  return scale > 0.0 ? v / scale : v;
}

// The part of a normal along the face normal, for the kernels to divide by.
float divisor(double cosine) {
  const auto most = static_cast<double>(LEAST_COSINE);
  return static_cast<float>(std::abs(cosine) < most ? std::copysign(most, cosine) : cosine);
}

}  // namespace

Triangle bake_triangle(const std::array<dvec3, 3>& positions, const std::array<dvec3, 3>& normals,
                       const SurfaceChoice& choice) {
  Triangle tri{};
  std::array<dvec3, 3> P{};
  std::array<dvec3, 3> N{};
  for (std::size_t i = 0; i < 3; ++i) {
    tri.Position[i] = rounded(positions[i]);
    tri.Normal[i] = rounded(normals[i]);
    P[i] = dvec3(tri.Position[i]);
    N[i] = dvec3(tri.Normal[i]);
  }
  dvec3 n = glm::cross(P[1] - P[0], P[2] - P[0]);
  // If rounding has flattened the triangle to a line, its face normal is that of before. If it was
  // a line before, for it is tiny and far from the scene's origin, any normal will do.
  if (n == dvec3(0.0)) {
    n = scaled(glm::cross(positions[1] - positions[0], positions[2] - positions[0]));
  }
  if (n == dvec3(0.0)) n = N[0];
  n = glm::normalize(n);
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    longest = std::max(longest, glm::distance(P[i], P[(i + 1) % 3]));
  }
  tri.TriNormal = rounded(n);
  tri.TriNormal.w = rounded_up(longest);
  bool displaced = true;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double cosine = glm::dot(N[k], dvec3(tri.TriNormal));
    tri.NormDot[i] = divisor(cosine);
    displaced = displaced && std::abs(cosine) >= static_cast<double>(LEAST_COSINE);
    // The neighbours, the lower-numbered one first.
    const dvec3 a = P[k == 0 ? 1 : 0] - P[k];
    const dvec3 b = P[k == 2 ? 1 : 2] - P[k];
    const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    tri.VertexData[i] = rounded({curvature(a, N[k], longest), curvature(b, N[k], longest),
                                 std::max(angle, 1.0 / kSteepest)});
  }
  // Flat triangles need no direction, and the normal shell does not divide.
  displaced = displaced || choice.surface == SURFACE_FLAT || choice.shell == SHELL_NORMAL;
  const Ball ball = bound_patch(displaced ? choice : SurfaceChoice{SURFACE_FLAT}, tri);
  const dvec3 center(glm::vec3(ball.center));
  tri.Domain = rounded(center);
  tri.Domain.w = rounded_up(ball.radius + glm::distance(center, ball.center));
  if (!displaced) tri.Domain.w = -tri.Domain.w;
  return tri;
}

std::size_t device_bytes(const BakedScene& scene) {
  return scene.triangles.size() * sizeof(Triangle) +
         scene.subpatches.size() * sizeof(SubpatchBounds) + scene.bvh.size() * sizeof(BvhNode);
}

namespace {

// The kernels compute fourth powers of lengths in single precision, with a range of 1e-38 to 1e38.
constexpr double kSmallest = 1e-9;
constexpr double kLargest = 1e9;

// Half the diagonal. Throws InputError if it is beyond these.
double extent_of(const Bounds& bounds) {
  const double span = glm::distance(bounds.low, bounds.high);
  if (!(span >= kSmallest && span <= kLargest)) {
    throw InputError(fmt::format(
        "the model spans {:g} units; single precision needs it between {:g} and {:g}: scale it.",
        span, kSmallest, kLargest));
  }
  return 0.5 * span;
}

BakedScene bake_within(const Mesh& mesh, const SurfaceChoice& choice, const Bounds& bounds,
                       const dvec3& origin) {
  BakedScene scene;
  scene.choice = choice;
  scene.origin = origin;
  scene.middle = middle_of(bounds) - origin;
  scene.extent = extent_of(bounds);
  const double farthest =
      glm::length(glm::max(glm::abs(bounds.low - origin), glm::abs(bounds.high - origin)));
  if (!(farthest <= kLargest)) {
    throw InputError(
        fmt::format("the model reaches {:g} units from the origin, farther than {:g}: move it.",
                    farthest, kLargest));
  }
  // At least: a patch may be several subpatches, and there may be a tree.
  expect_memory(static_cast<double>(mesh.triangles.size()) *
                    static_cast<double>(sizeof(Triangle) + sizeof(SubpatchBounds)),
                fmt::format("the surface of {} triangles", mesh.triangles.size()));
  scene.triangles.resize(mesh.triangles.size());
  scene.has_colors = !mesh.colors.empty();
  parallel_chunks(mesh.triangles.size(), kChunk, [&](std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k) {
      const MeshTriangle& t = mesh.triangles[k];
      std::array<dvec3, 3> positions{};
      std::array<dvec3, 3> normals{};
      for (std::size_t i = 0; i < 3; ++i) {
        positions[i] = mesh.positions[t.vertex[i]] - scene.origin;
        normals[i] = mesh.normals[t.normal[i]];
      }
      scene.triangles[k] = bake_triangle(positions, normals, choice);
      if (!scene.has_colors) continue;
      for (int i = 0; i < 3; ++i) scene.triangles[k].Position[i].w = mesh.colors[k][i];
    }
  });
  for (const Triangle& tri : scene.triangles) {
    if (!has_surface(tri)) continue;
    const vec4& domain = tri.Domain;
    scene.radius =
        std::max(scene.radius, glm::length(dvec3(domain)) + static_cast<double>(domain.w));
  }
  if (count_without_surface(scene) == scene.triangles.size()) {
    throw InputError(
        "no triangle has a surface in the height shell, for each has a normal in its face's plane: "
        "take the normal shell.");
  }
  return scene;
}

}  // namespace

void expect_size(const Mesh& mesh) {
  extent_of(bounds_of(mesh.positions));
}

BakedScene bake(const Mesh& mesh, const SurfaceChoice& choice) {
  const Bounds bounds = bounds_of(mesh.positions);
  return bake_within(mesh, choice, bounds, middle_of(bounds));
}

BakedScene bake_about(const Mesh& mesh, const SurfaceChoice& choice, const dvec3& origin) {
  return bake_within(mesh, choice, bounds_of(mesh.positions), origin);
}

std::size_t count_without_surface(const BakedScene& scene) {
  return static_cast<std::size_t>(
      std::count_if(scene.triangles.begin(), scene.triangles.end(),
                    [](const Triangle& tri) { return !has_surface(tri); }));
}

}  // namespace trisect
