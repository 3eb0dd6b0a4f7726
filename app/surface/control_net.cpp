#include "app/surface/control_net.h"

#include "app/surface/surface_double.h"

namespace trisect {
namespace {

in_double::ControlNet3D net_of(const Patch& patch, const DisplacementQuadratic& q,
                               const in_double::SubTriangle& sub_triangle) {
  const auto& [P0, P1, P2] = patch.P;
  const auto& [D0, D1, D2] = patch.D;
  return in_double::control_net_3d({P0, P1, P2, D0, D1, D2}, q.corner, q.edge, sub_triangle);
}

}  // namespace

double DisplacementQuadratic::blossom(const glm::dvec3& a, const glm::dvec3& b) const {
  return in_double::blossom(corner, edge, a, b);
}

std::array<glm::dvec3, 10> control_points(const Patch& patch, const DisplacementQuadratic& q,
                                          const in_double::SubTriangle& sub_triangle) {
  const in_double::ControlNet3D net = net_of(patch, q, sub_triangle);
  return {net.b300, net.b030, net.b003, net.b210, net.b120,
          net.b021, net.b012, net.b102, net.b201, net.b111};
}

TangentNet tangent_net(const Patch& patch, const DisplacementQuadratic& q,
                       const in_double::SubTriangle& sub_triangle) {
  const in_double::Tangents3D t = in_double::tangents(net_of(patch, q, sub_triangle));
  return {{t.u0, t.u1, t.u2, t.u3, t.u4, t.u5}, {t.v0, t.v1, t.v2, t.v3, t.v4, t.v5}};
}

DisplacementQuadratic phong_quadratic(const Patch& patch, double alpha) {
  DisplacementQuadratic q;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const std::size_t next = (k + 1) % 3;
    // A product w_i w_j has the Bernstein coefficient 1/2 at its edge.
    q.edge[i] = 0.5 * (alpha * glm::dot(patch.P[next] - patch.P[k], patch.N[next] - patch.N[k]));
  }
  return q;
}

}  // namespace trisect
