#include "app/surface/to_double.h"

namespace trisect {

SurfaceChoice with_single_alpha(const SurfaceChoice& choice) {
  return {choice.surface, static_cast<double>(static_cast<float>(choice.alpha)), choice.shell};
}

in_double::Shape shape_of(const SurfaceChoice& choice) {
  return {choice.surface, choice.shell, choice.alpha};
}

in_double::Triangle to_double(const Triangle& tri) {
  in_double::Triangle wide{};
  for (int i = 0; i < 3; ++i) {
    wide.Position[i] = glm::dvec4(tri.Position[i]);
    wide.Normal[i] = glm::dvec4(tri.Normal[i]);
    wide.VertexData[i] = glm::dvec4(tri.VertexData[i]);
  }
  wide.TriNormal = glm::dvec4(tri.TriNormal);
  wide.NormDot = glm::dvec4(tri.NormDot);
  wide.Domain = glm::dvec4(tri.Domain);
  return wide;
}

}  // namespace trisect
