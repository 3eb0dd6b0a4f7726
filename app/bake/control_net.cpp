#include "app/bake/control_net.h"

namespace trisect {

using glm::dvec3;

SubTriangle enlarged(const SubTriangle& part, double margin) {
  return {part.origin - dvec3(margin * part.size), part.size * (1.0 + 3.0 * margin)};
}

std::array<dvec3, 3> corners_of(const SubTriangle& part) {
  const auto corner = [&](int k) { return part.origin + corner_weights(k) * part.size; };
  return {corner(0), corner(1), corner(2)};
}

Corners corners_of(const in_double::Triangle& tri, uint shell) {
  Corners corners{};
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    corners.P[k] = dvec3(tri.Position[i]);
    corners.D[k] = in_double::corner_direction(shell, tri.Normal[i], tri.NormDot[i]);
  }
  return corners;
}

dvec3 corner_weights(int k) {
  dvec3 e(0.0);
  e[k] = 1.0;
  return e;
}

ControlNet net_of(const Corners& corners, const SubTriangle& part, const DisplacementQuadratic& q) {
  const std::array<dvec3, 3> w = corners_of(part);
  std::array<dvec3, 3> T{};
  std::array<dvec3, 3> D{};
  for (std::size_t i = 0; i < 3; ++i) {
    T[i] = in_double::weigh(w[i], corners.P[0], corners.P[1], corners.P[2]);
    D[i] = in_double::weigh(w[i], corners.D[0], corners.D[1], corners.D[2]);
  }
  const auto at = [&](std::size_t a, std::size_t b, std::size_t c) {
    const dvec3 lifted =
        D[a] * q.blossom(w[b], w[c]) + D[b] * q.blossom(w[c], w[a]) + D[c] * q.blossom(w[a], w[b]);
    return (T[a] + T[b] + T[c] + lifted) / 3.0;
  };
  return {at(0, 0, 0), at(1, 1, 1), at(2, 2, 2), at(0, 0, 1), at(0, 1, 1),
          at(1, 1, 2), at(1, 2, 2), at(0, 2, 2), at(0, 0, 2), at(0, 1, 2)};
}

}  // namespace trisect
