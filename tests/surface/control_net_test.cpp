// Sub-triangles and the control points over them.
#include "app/surface/control_net.h"

#include <gtest/gtest.h>

#include "app/surface/surface_double.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

// Exactly, and in this order.
TEST(SubTriangle, ItsChildrenHaveTheMidpointsOfItsEdgesForCorners) {
  in_double::SubTriangle node = in_double::enlarged(kWholeTriangle, CONE_MARGIN);
  for (uint k = 0; k < 12; ++k) {
    const CornerWeights w = corner_weights(node);
    const dvec3 a = (w[1] + w[2]) * 0.5;
    const dvec3 b = (w[2] + w[0]) * 0.5;
    const dvec3 c = (w[0] + w[1]) * 0.5;
    const auto quarters = quarter(node);
    EXPECT_EQ(corner_weights(quarters[0]), (CornerWeights{w[0], c, b}));
    EXPECT_EQ(corner_weights(quarters[1]), (CornerWeights{c, w[1], a}));
    EXPECT_EQ(corner_weights(quarters[2]), (CornerWeights{b, a, w[2]}));
    EXPECT_EQ(corner_weights(quarters[3]), (CornerWeights{a, b, c}));
    for (uint i = 0; i < 4; ++i) {
      const in_double::SubTriangle back = in_double::parent(quarters[i], i);
      EXPECT_EQ(back.origin, node.origin);
      EXPECT_EQ(back.size, node.size);
    }
    node = quarters[(k * 7) % 4];
  }
}

// The Bernstein form of the control points has the points of T + q D, that of the control vectors a
// third of the derivatives.
TEST(ControlNet, IsThatOfTheDisplacedTriangle) {
  Patch patch{};
  patch.P = {dvec3(0.1, -0.3, 0.2), dvec3(1.2, 0.1, -0.1), dvec3(0.4, 0.9, 0.3)};
  patch.D = {dvec3(0.2, 0.1, 0.9), dvec3(-0.3, 0.4, 1.1), dvec3(0.5, -0.2, 0.7)};
  const DisplacementQuadratic q{dvec3(0.3, -0.2, 0.5), dvec3(0.1, -0.4, 0.7)};
  const auto point = [&](const dvec3& w) {
    return weigh(w, patch.P) + weigh(w, patch.D) * q.blossom(w, w);
  };
  for (const in_double::SubTriangle& node : quarter(in_double::with_overlap(kWholeTriangle))) {
    const auto b = control_points(patch, q, node);
    const TangentNet tangents = tangent_net(patch, q, node);
    for (const dvec3& l : test::weight_grid(5)) {
      const dvec3 expected = point(in_double::weights_of(node, l));
      const dvec3 sum =
          b[0] * l.x * l.x * l.x + b[1] * l.y * l.y * l.y + b[2] * l.z * l.z * l.z +
          3.0 * (b[3] * l.x * l.x * l.y + b[4] * l.x * l.y * l.y + b[5] * l.y * l.y * l.z +
                 b[6] * l.y * l.z * l.z + b[7] * l.x * l.z * l.z + b[8] * l.x * l.x * l.z) +
          6.0 * b[9] * l.x * l.y * l.z;
      EXPECT_LT(glm::distance(sum, expected), 1e-14);
      // u_i and v_i in the order of their Bernstein polynomials: 00 11 22 01 02 12.
      const std::array<double, 6> bernstein{l.x * l.x,       l.y * l.y,       l.z * l.z,
                                            2.0 * l.x * l.y, 2.0 * l.x * l.z, 2.0 * l.y * l.z};
      dvec3 u(0.0);
      dvec3 v(0.0);
      for (std::size_t i = 0; i < 6; ++i) {
        u += 3.0 * bernstein[i] * tangents.u[i];
        v += 3.0 * bernstein[i] * tangents.v[i];
      }
      // Central differences of a cubic are off by the square of the step.
      constexpr double h = 1e-4;
      const auto slope = [&](const dvec3& d) {
        return (point(in_double::weights_of(node, l + d * h)) -
                point(in_double::weights_of(node, l - d * h))) /
               (2.0 * h);
      };
      EXPECT_LT(glm::distance(u, slope({-1.0, 1.0, 0.0})), 1e-7);
      EXPECT_LT(glm::distance(v, slope({-1.0, 0.0, 1.0})), 1e-7);
    }
  }
}

}  // namespace
}  // namespace trisect
