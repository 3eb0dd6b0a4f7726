#include "app/bench/nearest_point.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "app/base/interval.h"
#include "app/mesh/bounds.h"

namespace trisect::bench {
namespace {

using glm::dvec3;

// Embree's tree is in single precision: it is asked for what is nearer than the nearest so far and
// this part of the numbers' size, twice what some eight roundings come to.
constexpr double kSlack = 1e-6;

std::vector<glm::vec3> about(const dvec3& middle, const std::vector<dvec3>& points) {
  std::vector<glm::vec3> result;
  result.reserve(points.size());
  for (const dvec3& point : points) result.emplace_back(point - middle);
  return result;
}

struct Query {
  const FlatMesh& mesh;
  dvec3 point;
  double slack;
  NearPoint best;
};

// Embree calls this for each triangle that its tree finds within the radius.
bool look_at(RTCPointQueryFunctionArguments* arguments) {
  Query& query = *static_cast<Query*>(arguments->userPtr);
  const NearPoint found = nearest_of_triangle(query.mesh, arguments->primID, query.point);
  // Of several at the same distance the first, whatever the order in which the tree has them.
  const bool nearer =
      found.distance < query.best.distance ||
      (found.distance == query.best.distance && found.triangle < query.best.triangle);
  if (!nearer) return false;
  query.best = found;
  arguments->query->radius = static_cast<float>(found.distance + query.slack);
  return true;
}

}  // namespace

NearPoint nearest_of_triangle(const FlatMesh& mesh, uint32_t triangle, const dvec3& point) {
  const glm::uvec3& corners = mesh.triangles[triangle];
  const glm::dmat3 p(mesh.positions[corners.x], mesh.positions[corners.y],
                     mesh.positions[corners.z]);
  const dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
  const double area = glm::dot(normal, normal);
  NearPoint best{kInfinity, triangle, {}};
  if (area > 0.0) {
    // The foot of the perpendicular, if it is within.
    dvec3 weights;
    weights.x = glm::dot(glm::cross(p[2] - p[1], point - p[1]), normal) / area;
    weights.y = glm::dot(glm::cross(p[0] - p[2], point - p[2]), normal) / area;
    weights.z = 1.0 - weights.x - weights.y;
    if (weights.x >= 0.0 && weights.y >= 0.0 && weights.z >= 0.0) {
      best = {glm::distance(point, p * weights), triangle, weights};
      // Of a sliver the foot may be farther off, by roundings, than the edges' nearest points.
      const dvec3 e = p[1] - p[0];
      const dvec3 f = p[2] - p[0];
      if (area > 1e-12 * glm::dot(e, e) * glm::dot(f, f)) return best;
    }
  }
  for (glm::length_t k = 0; k < 3; ++k) {
    const glm::length_t next = (k + 1) % 3;
    const dvec3 edge = p[next] - p[k];
    const double length = glm::dot(edge, edge);
    const double along =
        length > 0.0 ? std::clamp(glm::dot(point - p[k], edge) / length, 0.0, 1.0) : 0.0;
    const double distance = glm::distance(point, p[k] + along * edge);
    if (!(distance < best.distance)) continue;
    best.distance = distance;
    best.weights = dvec3(0.0);
    best.weights[k] = 1.0 - along;
    best.weights[next] = along;
  }
  return best;
}

NearestPoint::NearestPoint(const FlatMesh& mesh)
    : mesh_(mesh),
      middle_(middle_of(bounds_of(mesh.positions))),
      extent_(glm::length(bounds_of(mesh.positions).high - middle_)),
      triangles_(about(middle_, mesh.positions), mesh.triangles) {}

NearPoint NearestPoint::to(const dvec3& point) const {
  const glm::vec3 at(point - middle_);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  RTCPointQuery query{};
  query.x = at.x;
  query.y = at.y;
  query.z = at.z;
  query.radius = std::numeric_limits<float>::infinity();
  Query state{mesh_, point, kSlack * (extent_ + glm::distance(point, middle_)), {kInfinity, 0, {}}};
  rtcPointQuery(triangles_.scene(), &query, &context, look_at, &state);
  return state.best;
}

}  // namespace trisect::bench
