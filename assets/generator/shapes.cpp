#include "assets/generator/shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace trisect::assets {
namespace {

using glm::dvec3;

constexpr double kTurn = 2.0 * glm::pi<double>();

Vertex on_unit_sphere(const dvec3& direction) {
  const dvec3 p = glm::normalize(direction);
  return {p, p};
}

void add_divided(Model& model, const dvec3& a, const dvec3& b, const dvec3& c, int divisions) {
  if (divisions == 0) {
    model.add_triangle(on_unit_sphere(a), on_unit_sphere(b), on_unit_sphere(c));
    return;
  }
  const dvec3 ab = glm::normalize(a + b);
  const dvec3 bc = glm::normalize(b + c);
  const dvec3 ca = glm::normalize(c + a);
  add_divided(model, a, ab, ca, divisions - 1);
  add_divided(model, ab, b, bc, divisions - 1);
  add_divided(model, ca, bc, c, divisions - 1);
  add_divided(model, ab, bc, ca, divisions - 1);
}

}  // namespace

Model sphere(int divisions) {
  Model model(fmt::format("Unit sphere from an icosahedron divided {} times", divisions));
  const double g = (1.0 + std::sqrt(5.0)) / 2.0;
  const std::array<dvec3, 12> corners{{{-1, g, 0},
                                       {1, g, 0},
                                       {-1, -g, 0},
                                       {1, -g, 0},
                                       {0, -1, g},
                                       {0, 1, g},
                                       {0, -1, -g},
                                       {0, 1, -g},
                                       {g, 0, -1},
                                       {g, 0, 1},
                                       {-g, 0, -1},
                                       {-g, 0, 1}}};
  constexpr std::array<std::array<std::size_t, 3>, 20> faces{
      {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
       {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
       {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (const auto& [a, b, c] : faces) {
    add_divided(model, glm::normalize(corners[a]), glm::normalize(corners[b]),
                glm::normalize(corners[c]), divisions);
  }
  return model;
}

Model torus(int finer) {
  Model model("Torus of radii 1 and 0.4");
  add_grid(model, 16 * finer, 8 * finer, [](double u, double v) -> Vertex {
    const dvec3 outward(std::sin(kTurn * u), 0.0, std::cos(kTurn * u));
    const dvec3 normal = outward * std::cos(kTurn * v) + dvec3(0.0, std::sin(kTurn * v), 0.0);
    return {outward + normal * 0.4, normal};
  });
  return model;
}

Model capsule(int finer) {
  Model model("Capsule of radius 0.5 and length 2");
  constexpr double radius = 0.5;
  const int columns = 16 * finer;
  const int rings = 3 * finer;  // of each half ball
  const auto at = [](double u, double latitude, double middle) -> Vertex {
    const double along = std::sin(latitude);
    const double across = std::cos(latitude);
    const dvec3 normal(across * std::sin(kTurn * u), along, across * std::cos(kTurn * u));
    return {normal * radius + dvec3(0.0, middle, 0.0), normal};
  };
  constexpr double quarter = glm::half_pi<double>();
  add_grid(model, columns, rings,
           [&](double u, double v) { return at(u, quarter * (v - 1.0), -0.5); });
  add_grid(model, columns, 2 * finer, [&](double u, double v) { return at(u, 0.0, v - 0.5); });
  add_grid(model, columns, rings, [&](double u, double v) { return at(u, quarter * v, 0.5); });
  return model;
}

Model cube() {
  Model model("Cube with hard edges");
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {1.0, -1.0}) {
      dvec3 n(0.0);
      dvec3 s(0.0);
      n[axis] = side;
      s[(axis + 1) % 3] = 1.0;
      const dvec3 t = glm::cross(n, s);
      model.add_quad({n - s - t, n}, {n + s - t, n}, {n + s + t, n}, {n - s + t, n});
    }
  }
  return model;
}

Model saddle(int finer) {
  Model model("Saddle y = (x^2 - z^2) / 2");
  add_grid(model, 4 * finer, 4 * finer, [](double u, double v) -> Vertex {
    const double x = 2.0 * u - 1.0;
    const double z = 1.0 - 2.0 * v;
    return {{x, (x * x - z * z) / 2.0, z}, glm::normalize(dvec3(-x, 1.0, z))};
  });
  return model;
}

Model relief(int finer) {
  Model model("Relief z = 0.2 cos(3 x) cos(3 y) + 0.1 x y");
  add_grid(model, 8 * finer, 5 * finer, [](double u, double v) -> Vertex {
    const double x = 3.2 * u - 1.6;
    const double y = 2.0 * v - 1.0;
    const double z = 0.2 * std::cos(3.0 * x) * std::cos(3.0 * y) + 0.1 * x * y;
    const double dx = -0.6 * std::sin(3.0 * x) * std::cos(3.0 * y) + 0.1 * y;
    const double dy = -0.6 * std::cos(3.0 * x) * std::sin(3.0 * y) + 0.1 * x;
    return {{x, y, z}, glm::normalize(dvec3(-dx, -dy, 1.0))};
  });
  return model;
}

}  // namespace trisect::assets
