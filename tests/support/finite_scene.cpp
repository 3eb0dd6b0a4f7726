#include "tests/support/finite_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace trisect::test {
namespace {

bool all_finite(std::initializer_list<vec4> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](const vec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
  });
}

bool is_usable(const Triangle& tri) {
  bool usable = all_finite({tri.Position[0], tri.Position[1], tri.Position[2], tri.Normal[0],
                            tri.Normal[1], tri.Normal[2], tri.TriNormal, tri.NormDot, tri.Domain,
                            tri.VertexData[0], tri.VertexData[1], tri.VertexData[2]});
  for (int i = 0; i < 3; ++i) {
    const vec4 direction = tri.Normal[i] / tri.NormDot[i];
    // The kernels' quotients have up to the fourth power of a direction.
    const float square = glm::dot(direction, direction);
    // And squares of curvatures times lengths.
    const vec4 data = tri.VertexData[i] * vec4(tri.TriNormal.w, tri.TriNormal.w, 1.0F, 1.0F);
    usable = usable && std::isfinite(square * square) && std::isfinite(data.x * data.x) &&
             std::isfinite(data.y * data.y) && std::isfinite(4.0F / data.z);
  }
  return usable;
}

bool is_usable(const SubpatchBounds& bounds) {
  return all_finite({bounds.ball, bounds.sub_triangle, bounds.corner, bounds.edge, bounds.cone,
                     vec4(bounds.gradient_lipschitz)}) &&
         bounds.ball.w >= 0.0F;
}

bool is_usable(const BvhNode& node) {
  return all_finite({{node.origin_x, node.origin_y, node.origin_z, 0.0F},
                     {node.step_x, node.step_y, node.step_z, 0.0F}});
}

template <typename Item>
std::string first_unusable(const char* name, const std::vector<Item>& items) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!is_usable(items[i])) return fmt::format("{} {}", name, i);
  }
  return "";
}

}  // namespace

std::string first_not_finite(const BakedScene& scene) {
  if (!std::isfinite(scene.radius) || !std::isfinite(scene.extent) ||
      !std::isfinite(glm::dot(scene.origin, scene.origin))) {
    return "size";
  }
  for (const std::string& found :
       {first_unusable("triangle", scene.triangles), first_unusable("subpatch", scene.subpatches),
        first_unusable("node of the tree", scene.bvh)}) {
    if (!found.empty()) return found;
  }
  return "";
}

}  // namespace trisect::test
