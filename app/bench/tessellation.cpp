#include "app/bench/tessellation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "app/base/parallel_rows.h"
#include "app/surface/patch_range.h"
#include "app/surface/surface_double.h"
#include "app/surface/to_double.h"

namespace trisect::bench {
namespace {

using glm::dvec3;

// Vertex `column` of row `row`, which has row + 1 of them; row 0 is the triangle's vertex 0.
template <typename Vec>
Vec weights_at(uint32_t n, uint32_t row, uint32_t column) {
  using Real = typename Vec::value_type;
  const auto part = [&](uint32_t i) { return static_cast<Real>(i) / static_cast<Real>(n); };
  return {part(n - row), part(row - column), part(column)};
}

uint32_t vertex_number(uint32_t row, uint32_t column) {
  return row * (row + 1) / 2 + column;
}

struct Corner {
  uint32_t row;
  uint32_t column;
};

// Row r has 2 r + 1 of the n^2 triangles, every other one upside down.
std::array<Corner, 3> corners_of(uint32_t index) {
  auto row = static_cast<uint32_t>(std::sqrt(static_cast<double>(index)));
  while (row * row > index) --row;
  while ((row + 1) * (row + 1) <= index) ++row;
  const uint32_t at = index - row * row;
  const uint32_t column = at / 2;
  if (at % 2 == 0) return {{{row, column}, {row + 1, column}, {row + 1, column + 1}}};
  return {{{row, column}, {row + 1, column + 1}, {row, column + 1}}};
}

// The error of one patch, in units of length.
double patch_error(const BakedScene& scene, const Triangle& baked, uint32_t n) {
  const in_double::Triangle tri = to_double(baked);
  const in_double::Shape shape = shape_of(scene.choice);
  std::vector<dvec3> points;
  points.reserve((n + 1) * (n + 2) / 2);
  for (uint32_t row = 0; row <= n; ++row) {
    for (uint32_t column = 0; column <= row; ++column) {
      points.push_back(in_double::surface_point(shape, tri, weights_at<dvec3>(n, row, column)));
    }
  }
  double worst = 0.0;
  for (uint32_t index = 0; index < n * n; ++index) {
    const std::array<Corner, 3> corners = corners_of(index);
    std::array<dvec3, 3> p;
    std::array<dvec3, 3> w;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = points[vertex_number(corners[k].row, corners[k].column)];
      w[k] = weights_at<dvec3>(n, corners[k].row, corners[k].column);
    }
    const dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double length = glm::length(normal);
    if (!(length > 0.0)) continue;
    for (const dvec3& l :
         {dvec3(1.0 / 3.0), dvec3(0.5, 0.5, 0.0), dvec3(0.0, 0.5, 0.5), dvec3(0.5, 0.0, 0.5)}) {
      const dvec3 on_surface =
          in_double::surface_point(shape, tri, w[0] * l.x + w[1] * l.y + w[2] * l.z);
      worst = std::max(worst, std::abs(glm::dot(on_surface - p[0], normal)) / length);
    }
  }
  return worst;
}

}  // namespace

Tessellation tessellate(const BakedScene& scene, uint32_t n) {
  const std::size_t vertices_of_patch = std::size_t{n + 1} * (n + 2) / 2;
  const std::size_t triangles_of_patch = std::size_t{n} * n;
  Tessellation flat;
  flat.n = n;
  flat.vertices.resize(scene.triangles.size() * vertices_of_patch);
  flat.triangles.resize(scene.triangles.size() * triangles_of_patch);
  const auto patch = [&](std::size_t t) {
    const in_double::Triangle tri = to_double(scene.triangles[t]);
    const in_double::Shape shape = shape_of(scene.choice);
    // What is to be seen of a patch without a surface is nothing: triangles without area.
    const bool displaced = has_surface(scene.triangles[t]);
    const std::size_t first = t * vertices_of_patch;
    for (uint32_t row = 0; row <= n; ++row) {
      for (uint32_t column = 0; column <= row; ++column) {
        flat.vertices[first + vertex_number(row, column)] =
            displaced ? in_double::surface_point(shape, tri, weights_at<dvec3>(n, row, column))
                      : dvec3(tri.Position[0]);
      }
    }
    for (uint32_t index = 0; index < triangles_of_patch; ++index) {
      const std::array<Corner, 3> c = corners_of(index);
      flat.triangles[t * triangles_of_patch + index] =
          glm::uvec3(vertex_number(c[0].row, c[0].column), vertex_number(c[1].row, c[1].column),
                     vertex_number(c[2].row, c[2].column)) +
          glm::uvec3(static_cast<uint32_t>(first));
    }
  };
  parallel_rows(static_cast<uint32_t>(scene.triangles.size()), patch, {});
  return flat;
}

glm::vec3 weights_in_patch(uint32_t n, uint32_t index, float u, float v) {
  const std::array<Corner, 3> c = corners_of(index);
  return weights_at<glm::vec3>(n, c[0].row, c[0].column) * (1.0F - u - v) +
         weights_at<glm::vec3>(n, c[1].row, c[1].column) * u +
         weights_at<glm::vec3>(n, c[2].row, c[2].column) * v;
}

double tessellation_error(const BakedScene& scene, uint32_t n) {
  double worst = 0.0;
  std::mutex mutex;
  const auto patch = [&](uint32_t t) {
    if (!has_surface(scene.triangles[t])) return;
    const double error = patch_error(scene, scene.triangles[t], n);
    const std::scoped_lock lock(mutex);
    worst = std::max(worst, error);
  };
  parallel_rows(static_cast<uint32_t>(scene.triangles.size()), patch, {});
  return worst / scene.radius;
}

uint32_t divisions_for(const BakedScene& scene, double error, uint32_t most) {
  // The error of a smooth surface is that of its quadratic part: it falls with the square of n.
  double n = 1.0;
  double found = tessellation_error(scene, 1);
  while (found > error && n < most) {
    const double next = n * std::clamp(std::sqrt(found / error), 1.02, 8.0);
    n = std::min(std::ceil(next), static_cast<double>(most));
    found = tessellation_error(scene, static_cast<uint32_t>(n));
  }
  return static_cast<uint32_t>(n);
}

uint32_t affordable_divisions_for(const BakedScene& scene, double error) {
  constexpr double most_triangles = 16e6;
  const double most = std::sqrt(most_triangles / static_cast<double>(scene.triangles.size()));
  return divisions_for(scene, error, static_cast<uint32_t>(std::max(most, 1.0)));
}

}  // namespace trisect::bench
