#include "app/bake/subpatch_boxes.h"

#include <limits>

#include "app/bake/control_net.h"
#include "app/base/parallel_rows.h"
#include "app/base/rounding.h"
#include "app/surface/to_double.h"

namespace trisect {
namespace {

using glm::dvec3;

PartBox part_box(const Triangle& single, const Cage& cage, uint shell, double slack) {
  const in_double::Triangle tri = widen(single);
  const SubTriangle part{dvec3(glm::vec3(cage.node)), cage.node.w};
  const CageQuadratic q{dvec3(glm::vec3(cage.corner)), dvec3(glm::vec3(cage.edge))};
  dvec3 lo(std::numeric_limits<double>::max());
  dvec3 hi = -lo;
  for (const dvec3& point : net_of(corners_of(tri, shell), enlarged(part, OVERLAP), q)) {
    lo = glm::min(lo, point);
    hi = glm::max(hi, point);
  }
  // Where the quadratic is a poor bound, or none, the part's ball is one.
  const dvec3 middle(cage.ball);
  const dvec3 stray(cage.corner.w);
  lo = glm::max(lo - stray, middle - dvec3(cage.ball.w)) - dvec3(slack);
  hi = glm::min(hi + stray, middle + dvec3(cage.ball.w)) + dvec3(slack);
  return {{rounded_down(lo.x), rounded_down(lo.y), rounded_down(lo.z)},
          {rounded_up(hi.x), rounded_up(hi.y), rounded_up(hi.z)}};
}

}  // namespace

std::vector<PartBox> part_boxes(const BakedScene& scene) {
  std::vector<PartBox> boxes(scene.cages.size());
  const double slack = static_cast<double>(BVH_SLACK) * scene.radius;
  parallel_chunks(boxes.size(), kChunk, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const Cage& cage = scene.cages[i];
      boxes[i] = part_box(scene.triangles[cage.triangle], cage, scene.choice.shell, slack);
    }
  });
  return boxes;
}

}  // namespace trisect
