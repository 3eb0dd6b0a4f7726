#include "app/bake/subpatch_boxes.h"

#include <limits>

#include "app/base/parallel_rows.h"
#include "app/base/rounding.h"
#include "app/surface/control_net.h"

namespace trisect {
namespace {

using glm::dvec3;

SubpatchBox subpatch_box(const Triangle& tri, const SubpatchBounds& bounds, uint shell,
                         double slack) {
  const in_double::SubTriangle sub_triangle{dvec3(bounds.sub_triangle), bounds.sub_triangle.w};
  const DisplacementQuadratic q{dvec3(glm::vec3(bounds.corner)), dvec3(glm::vec3(bounds.edge))};
  dvec3 lo(std::numeric_limits<double>::max());
  dvec3 hi = -lo;
  for (const dvec3& point :
       control_points(patch_of(shell, tri), q, in_double::with_overlap(sub_triangle))) {
    lo = glm::min(lo, point);
    hi = glm::max(hi, point);
  }
  // The box lies in that of the ball, too: where the quadratic bounds poorly, or not at all, the
  // ball does.
  const dvec3 middle(bounds.ball);
  const dvec3 position_error(bounds.corner.w);
  lo = glm::max(lo - position_error, middle - dvec3(bounds.ball.w)) - dvec3(slack);
  hi = glm::min(hi + position_error, middle + dvec3(bounds.ball.w)) + dvec3(slack);
  return {{rounded_down(lo.x), rounded_down(lo.y), rounded_down(lo.z)},
          {rounded_up(hi.x), rounded_up(hi.y), rounded_up(hi.z)}};
}

}  // namespace

std::vector<SubpatchBox> subpatch_boxes(const BakedScene& scene) {
  std::vector<SubpatchBox> boxes(scene.subpatches.size());
  const double slack = static_cast<double>(BVH_SLACK) * scene.radius;
  parallel_chunks(boxes.size(), kChunk, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const SubpatchBounds& bounds = scene.subpatches[i];
      boxes[i] = subpatch_box(scene.triangles[bounds.triangle], bounds, scene.choice.shell, slack);
    }
  });
  return boxes;
}

}  // namespace trisect
