#include "app/stress/stress_scenes.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>
#include <utility>

#include "app/surface/surface_double.h"
#include "app/surface/to_double.h"

namespace trisect::stress {
namespace {

using glm::dvec3;

Mesh icosahedron() {
  const double g = glm::golden_ratio<double>();
  Mesh mesh;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-g, g}) {
      mesh.positions.emplace_back(a, b, 0.0);
      mesh.positions.emplace_back(0.0, a, b);
      mesh.positions.emplace_back(b, 0.0, a);
    }
  }
  for (dvec3& p : mesh.positions) p = glm::normalize(p);
  mesh.normals = mesh.positions;
  // The faces are the triples of vertices that are an edge's length apart, wound to face outward.
  const double edge = 2.0 / std::sqrt(2.0 + g);
  const auto near = [&](uint32_t i, uint32_t j) {
    return glm::distance(mesh.positions[i], mesh.positions[j]) < 1.01 * edge;
  };
  for (uint32_t i = 0; i < 12; ++i) {
    for (uint32_t j = i + 1; j < 12; ++j) {
      for (uint32_t k = i + 1; k < 12; ++k) {
        if (k == j || !near(i, j) || !near(j, k) || !near(i, k)) continue;
        const dvec3& p = mesh.positions[i];
        const dvec3 n = glm::cross(mesh.positions[j] - p, mesh.positions[k] - p);
        if (glm::dot(n, p) > 0.0) mesh.triangles.push_back({{i, j, k}, {i, j, k}});
      }
    }
  }
  return mesh;
}

Mesh divided_on_sphere(const Mesh& mesh) {
  Mesh finer;
  finer.positions = mesh.positions;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
  const auto middle = [&](uint32_t a, uint32_t b) {
    const auto [found, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(finer.positions.size()));
    if (is_new) {
      finer.positions.push_back(glm::normalize(finer.positions[a] + finer.positions[b]));
    }
    return found->second;
  };
  for (const MeshTriangle& t : mesh.triangles) {
    const auto [a, b, c] = t.vertex;
    const uint32_t ab = middle(a, b);
    const uint32_t bc = middle(b, c);
    const uint32_t ca = middle(c, a);
    for (const std::array<uint32_t, 3>& v :
         {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
      finer.triangles.push_back({v, v});
    }
  }
  finer.normals = finer.positions;
  return finer;
}

}  // namespace

Mesh patch(const Corners& positions, const Corners& normals) {
  Mesh mesh{{positions.begin(), positions.end()}, {}, {{{0, 1, 2}, {0, 1, 2}}}};
  for (const dvec3& n : normals) mesh.normals.push_back(glm::normalize(n));
  return mesh;
}

Mesh plain_patch(const Corners& normals) {
  return patch({dvec3(-1, 0, 0), dvec3(1, 0, 0), dvec3(0, 1, 0)}, normals);
}

Mesh leaning_patch(double degrees) {
  const double out = std::tan(glm::radians(degrees));
  const dvec3 up(0, 0, 1);
  return plain_patch({up + out * glm::normalize(dvec3(-1, -1.0 / 3.0, 0)),
                      up + out * glm::normalize(dvec3(1, -1.0 / 3.0, 0)),
                      up + out * dvec3(0, 1, 0)});
}

Mesh joined(const Mesh& a, const Mesh& b, const dvec3& move) {
  Mesh mesh = a;
  const auto positions = static_cast<uint32_t>(a.positions.size());
  const auto normals = static_cast<uint32_t>(a.normals.size());
  for (const dvec3& p : b.positions) mesh.positions.push_back(p + move);
  mesh.normals.insert(mesh.normals.end(), b.normals.begin(), b.normals.end());
  for (MeshTriangle t : b.triangles) {
    for (uint32_t& v : t.vertex) v += positions;
    for (uint32_t& n : t.normal) n += normals;
    mesh.triangles.push_back(t);
  }
  return mesh;
}

Mesh sphere(int levels) {
  Mesh mesh = icosahedron();
  for (int level = 0; level < levels; ++level) mesh = divided_on_sphere(mesh);
  return mesh;
}

Mesh moved(Mesh mesh, double scale, const dvec3& move) {
  for (dvec3& p : mesh.positions) p = p * scale + move;
  return mesh;
}

Mesh height_grid(int n, double a, double b) {
  Mesh mesh;
  const auto row = static_cast<uint32_t>(n + 1);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = 2.0 * i / n - 1.0;
      const double y = 2.0 * j / n - 1.0;
      mesh.positions.emplace_back(x, y, a * x * x + b * y * y);
      mesh.normals.push_back(glm::normalize(dvec3(-2.0 * a * x, -2.0 * b * y, 1.0)));
    }
  }
  for (uint32_t j = 0; j + 1 < row; ++j) {
    for (uint32_t i = 0; i + 1 < row; ++i) {
      const uint32_t v = j * row + i;
      const std::array<uint32_t, 3> low{v, v + 1, v + row};
      const std::array<uint32_t, 3> high{v + 1, v + row + 1, v + row};
      mesh.triangles.push_back({low, low});
      mesh.triangles.push_back({high, high});
    }
  }
  return mesh;
}

dvec3 any_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  dvec3 d(0.0);
  while (glm::length(d) < 1e-3) d = {normal(random), normal(random), normal(random)};
  return glm::normalize(d);
}

dvec3 across(const dvec3& axis, std::mt19937_64& random) {
  dvec3 d(0.0);
  while (glm::length(d) < 1e-3) d = glm::cross(axis, any_direction(random));
  return glm::normalize(d);
}

SurfacePoint point_at(const BakedScene& scene, uint32_t triangle, const dvec3& weights) {
  const in_double::Triangle tri = to_double(scene.triangles.at(triangle));
  const in_double::Shape shape = shape_of(with_single_alpha(scene.choice));
  return {triangle, weights, in_double::surface_point(shape, tri, weights),
          in_double::geometric_normal(shape, tri, weights)};
}

SurfacePoint any_point(const BakedScene& scene, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto triangle = static_cast<uint32_t>(random() % scene.triangles.size());
  double u = unit(random);
  double v = unit(random);
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  return point_at(scene, triangle, {1.0 - u - v, u, v});
}

CastRay ray_through(const BakedScene& scene, const dvec3& point, const dvec3& direction) {
  const dvec3 d = glm::normalize(direction);
  return ray_exactly_through(scene, point - d * glm::dot(point, d), d);
}

CastRay ray_exactly_through(const BakedScene& scene, const dvec3& point, const dvec3& direction) {
  const double nearest = -2.0 * (scene.radius + glm::length(point));
  return {vec4(glm::vec3(point), static_cast<float>(nearest)),
          vec4(glm::vec3(glm::normalize(direction)), 0.0F)};
}

std::vector<CastRay> rays_at_surface(const BakedScene& scene, std::mt19937_64& random, int count) {
  std::vector<CastRay> rays;
  for (int i = 0; i < count; ++i) {
    const SurfacePoint point = any_point(scene, random);
    dvec3 direction = any_direction(random);
    if (i % 4 == 3 && std::isfinite(point.normal.x)) {
      direction = glm::normalize(across(point.normal, random) + direction * 0.02);
    }
    rays.push_back(ray_through(scene, point.position, direction));
  }
  return rays;
}

}  // namespace trisect::stress
