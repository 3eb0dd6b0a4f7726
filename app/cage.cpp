#include "app/cage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/cage_net.h"
#include "app/enclosing_ball.h"
#include "app/kernel_float.h"
#include "app/parallel_rows.h"
#include "app/raise.h"
#include "app/rounding.h"
#include "app/surface_double.h"
#include "app/widen.h"

namespace trisect {
namespace {

using glm::dvec3;

// A cage's quadratic must follow sigma to this part of the longest edge of its part of the
// triangle, and its tangents S's to this part of it; else the part is divided, at most so many
// times.
constexpr double kClose = 0.02;
constexpr double kTangentsClose = 0.1;
constexpr int kMostLevels = 6;

// Rays are quick along the directions of a part's cone (Cage::cone), whose w should be at most so
// large; else the part is divided, for this reason no further than to 4^2 parts of a patch.
constexpr float kWide = 0.3F;
constexpr int kLevelsForCones = 2;
const vec4 kNoCone(0.0F, 0.0F, 0.0F, NO_CONE);

// sigma is sampled at the weights with this denominator; between the samples it may stray further
// by this factor.
constexpr int kSamples = 12;
constexpr double kBetweenSamples = 1.5;

struct Patch {
  in_double::Shape shape;
  in_double::Triangle tri;
  Corners corners;
  glm::vec3 bulges;  // the kernels' edge_bulges
};

struct Fit {
  CageQuadratic q;
  double stray = 0.0;          // of S, a length
  double tangent_stray = 0.0;  // of S_u and S_v
  double bend = 0.0;           // Cage::bend
};

Patch patch_of(const SurfaceChoice& choice, const Triangle& single, in_float::Kernel& kernel) {
  const in_double::Triangle tri = widen(single);
  return {shape_of(choice), tri, corners_of(tri, choice.shell),
          kernel.edge_bulges(single, static_cast<float>(choice.alpha))};
}

// The quadratic with these values at the part's corners and at the middles of its edges.
template <typename Value>
CageQuadratic through(const SubTriangle& part, Value&& value) {
  const auto at = [&](const dvec3& l) { return value(part.origin + l * part.size); };
  CageQuadratic local;
  for (int k = 0; k < 3; ++k) local.corner[k] = at(corner_weights(k));
  for (int k = 0; k < 3; ++k) {
    const int i = k == 2 ? 0 : k;
    const int j = k == 2 ? 2 : k + 1;
    local.edge[k] = 2.0 * at((corner_weights(i) + corner_weights(j)) * 0.5) -
                    (local.corner[i] + local.corner[j]) * 0.5;
  }
  // In the weights of the whole: the blossom does not mind that the corners lie outside the part.
  const auto inside = [&](int k) { return (corner_weights(k) - part.origin) / part.size; };
  CageQuadratic whole;
  for (int k = 0; k < 3; ++k) whole.corner[k] = local.blossom(inside(k), inside(k));
  whole.edge = {local.blossom(inside(0), inside(1)), local.blossom(inside(1), inside(2)),
                local.blossom(inside(0), inside(2))};
  return whole;
}

double longest_direction(const Patch& patch) {
  return std::max({glm::length(patch.corners.D[0]), glm::length(patch.corners.D[1]),
                   glm::length(patch.corners.D[2])});
}

// sigma - q and its gradient.
struct Sample {
  dvec3 w;
  double e;
  glm::dvec2 gradient;
};

Sample sample(const Patch& patch, const CageQuadratic& q, const dvec3& w) {
  const in_double::Displacement sigma =
      in_double::displacement_and_derivatives(patch.shape, patch.tri, w);
  return {w,
          sigma.s - q.blossom(w, w),
          {sigma.u - 2.0 * q.blossom(w, {-1.0, 1.0, 0.0}),
           sigma.v - 2.0 * q.blossom(w, {-1.0, 0.0, 1.0})}};
}

std::vector<Sample> samples_of(const Patch& patch, const SubTriangle& part,
                               const CageQuadratic& q) {
  std::vector<Sample> samples;
  for (int i = 0; i <= kSamples; ++i) {
    for (int j = 0; i + j <= kSamples; ++j) {
      const dvec3 l = dvec3(kSamples - i - j, i, j) / static_cast<double>(kSamples);
      samples.push_back(sample(patch, q, part.origin + l * part.size));
    }
  }
  return samples;
}

// Raises `stray` to how far S_u and S_v are from the cage's at the sample.
void raise_tangent_stray(const Patch& patch, const Sample& a, double& stray) {
  const dvec3 D = in_double::weigh(a.w, patch.corners.D[0], patch.corners.D[1], patch.corners.D[2]);
  raise(stray, glm::length(D * a.gradient.x + (patch.corners.D[1] - patch.corners.D[0]) * a.e));
  raise(stray, glm::length(D * a.gradient.y + (patch.corners.D[2] - patch.corners.D[0]) * a.e));
}

Fit fit(const Patch& patch, const SubTriangle& part) {
  const bool cubic = in_double::is_cubic(patch.shape);
  Fit fit;
  // Of a cubic patch as the kernels have it from the triangle, to the bit.
  fit.q = cubic ? CageQuadratic{dvec3(0.0), dvec3(patch.bulges) * 0.5}
                : through(part, [&](const dvec3& w) {
                    return in_double::displacement(patch.shape, patch.tri, w);
                  });
  const double longest_D = longest_direction(patch);
  // Rounding of the coefficients to single precision.
  constexpr double rounding = 2e-7;
  const dvec3 size = glm::max(glm::abs(fit.q.corner), glm::abs(fit.q.edge));
  const double rounded = rounding * std::max({size.x, size.y, size.z}) * longest_D;
  if (cubic) {
    fit.stray = rounded;
    fit.tangent_stray = rounded;
    return fit;
  }
  const std::vector<Sample> samples = samples_of(patch, part, fit.q);
  for (const Sample& a : samples) {
    const dvec3 D =
        in_double::weigh(a.w, patch.corners.D[0], patch.corners.D[1], patch.corners.D[2]);
    raise(fit.stray, glm::length(D) * std::abs(a.e));
    raise_tangent_stray(patch, a, fit.tangent_stray);
    for (const Sample& b : samples) {
      const double distance = std::hypot(a.w.y - b.w.y, a.w.z - b.w.z);
      // Neighbours on the grid; those farther away have been seen in steps.
      if (distance > 0.0 && distance * kSamples < 1.5 * std::abs(part.size)) {
        raise(fit.bend, glm::distance(a.gradient, b.gradient) / distance * longest_D);
      }
    }
  }
  const auto widened = [&](double stray) {
    return std::isfinite(stray) ? stray * kBetweenSamples + rounded
                                : static_cast<double>(std::numeric_limits<float>::max());
  };
  fit.stray = widened(fit.stray);
  fit.tangent_stray = widened(fit.tangent_stray);
  fit.bend = widened(fit.bend);
  return fit;
}

// The ball around a part, its overlap with the next ones included.
Ball part_ball(const Patch& patch, const SubTriangle& part, const Fit& fit) {
  std::vector<Ball> points;
  for (const dvec3& point : net_of(patch.corners, enlarged(part, OVERLAP), fit.q)) {
    points.push_back({point, fit.stray});
  }
  Ball ball = enclosing_ball(points);
  ball.radius += 1e-6 * (ball.radius + glm::length(ball.center));  // rounding to single precision
  return ball;
}

// The most by which a matrix lengthens a vector.
double norm_of(const glm::dmat2& m) {
  // Half the sum and half the difference of its singular values.
  return 0.5 * (std::hypot(m[0][0] + m[1][1], m[0][1] - m[1][0]) +
                std::hypot(m[0][0] - m[1][1], m[0][1] + m[1][0]));
}

// How far S_u and S_v stray over an enlarged part from those of its cage.
double tangents_stray(const Patch& patch, const SubTriangle& part, const Fit& fit) {
  if (fit.bend == 0.0) return fit.tangent_stray;
  double most = 0.0;
  for (const Sample& a : samples_of(patch, part, fit.q)) raise_tangent_stray(patch, a, most);
  return std::max(kBetweenSamples * most, fit.tangent_stray);
}

// Cage::cone. S_u and S_v at a point are the same convex combination of the control vectors u_i and
// v_i; so is their mean along a line from one point to another, with which S differs between them.
// Seen along a direction d, on the tangent plane with normal n and mean tangents M0, that mean is
// M0 (1 + E - t g^T), t the tangent of the angle between d and n, E and g those of (u_i, v_i): it
// is one to one if |E| + t |g| < 1 for all i.
vec4 normal_cone(const Patch& patch, const SubTriangle& part, const Fit& fit) {
  const SubTriangle large = enlarged(part, CONE_MARGIN);
  const ControlNet b = net_of(patch.corners, large, fit.q);
  const std::array<dvec3, 6> u{b[3] - b[0], b[1] - b[4], b[6] - b[7],
                               b[4] - b[3], b[9] - b[8], b[5] - b[9]};
  const std::array<dvec3, 6> v{b[8] - b[0], b[5] - b[4], b[2] - b[7],
                               b[9] - b[3], b[7] - b[8], b[6] - b[9]};
  dvec3 mean_u(0.0);
  dvec3 mean_v(0.0);
  for (std::size_t i = 0; i < 6; ++i) {
    mean_u += u[i] / 6.0;
    mean_v += v[i] / 6.0;
  }
  const dvec3 n = glm::normalize(glm::cross(mean_u, mean_v));
  const dvec3 x = glm::normalize(mean_u);
  const dvec3 y = glm::cross(n, x);
  const auto in_plane = [&](const dvec3& a) { return glm::dvec2(glm::dot(a, x), glm::dot(a, y)); };
  const glm::dmat2 inverse = glm::inverse(glm::dmat2(in_plane(mean_u), in_plane(mean_v)));
  const double stray = tangents_stray(patch, large, fit) * std::abs(large.size) / 3.0 *
                       std::sqrt(2.0) * norm_of(inverse);
  // The largest |g| / (1 - |E|): the cotangent of the smallest angle with n that is too large.
  double flattest = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    const glm::dmat2 change =
        glm::dmat2(in_plane(u[i]), in_plane(v[i])) * inverse - glm::dmat2(1.0);
    const double room = 1.0 - norm_of(change) - stray;
    // Written so that a NaN has no cone.
    if (!(room > 0.0)) return kNoCone;
    const double bend =
        glm::length(glm::dvec2(glm::dot(u[i], n), glm::dot(v[i], n)) * inverse) + stray;
    raise(flattest, bend / room);
  }
  constexpr double narrowest = 10.0;
  if (!(flattest < narrowest)) return kNoCone;
  // Of the ray's direction and the axis in single precision.
  constexpr double rounding = 1e-5;
  return {glm::vec3(n), static_cast<float>(flattest / std::hypot(flattest, 1.0) + rounding)};
}

Cage cage_of(const Patch& patch, const SubTriangle& part, const Fit& fit, uint32_t triangle) {
  Cage cage{};
  // Where the quadratic is no bound at all the whole patch's ball is one.
  if (part.size == 1.0 || !(fit.stray < patch.tri.Domain.w)) {
    cage.ball = vec4(patch.tri.Domain);
  } else {
    const Ball ball = part_ball(patch, part, fit);
    cage.ball = vec4(glm::vec3(ball.center), rounded_up(ball.radius));
  }
  cage.node = vec4(glm::vec3(part.origin), static_cast<float>(part.size));
  cage.corner = vec4(glm::vec3(fit.q.corner), rounded_up(fit.stray));
  cage.edge = vec4(glm::vec3(fit.q.edge), rounded_up(fit.tangent_stray));
  cage.cone = kNoCone;
  cage.triangle = triangle;
  cage.bend = fit.bend > 0.0 ? rounded_up(fit.bend) : 0.0F;
  // Less than the roundings of a position.
  constexpr double nothing = 1e-9;
  const dvec3 most = glm::max(glm::abs(fit.q.corner), glm::abs(fit.q.edge));
  const double displacement =
      std::max({most.x, most.y, most.z}) * longest_direction(patch) + fit.stray;
  const bool no_displacement = displacement <= nothing * patch.tri.TriNormal.w;
  cage.flat_part = no_displacement ? 1 : 0;
  return cage;
}

void cage_part(const Patch& patch, const SubTriangle& part, int level, uint32_t triangle,
               std::vector<Cage>& cages) {
  const Fit found = fit(patch, part);
  const double size = patch.tri.TriNormal.w * std::abs(part.size);
  const bool close =
      found.stray <= kClose * size && found.tangent_stray <= kTangentsClose * patch.tri.TriNormal.w;
  const std::size_t index = cages.size();
  cages.push_back(cage_of(patch, part, found, triangle));
  if (close || level == kMostLevels) {
    cages[index].cone = normal_cone(patch, part, found);
    if (cages[index].cone.w <= kWide || level >= kLevelsForCones) return;
  }
  const double half = part.size * 0.5;
  for (int k = 0; k < 3; ++k) {
    cage_part(patch, {part.origin + corner_weights(k) * half, half}, level + 1, triangle, cages);
  }
  cage_part(patch, {part.origin + dvec3(half), -half}, level + 1, triangle, cages);
  cages[index].skip = static_cast<uint32_t>(cages.size() - index - 1);
}

}  // namespace

bool has_groups(const BakedScene& scene) {
  return std::any_of(scene.cages.begin(), scene.cages.end(),
                     [](const Cage& cage) { return cage.skip > 0; });
}

std::vector<Cage> bake_cages(const BakedScene& scene) {
  std::vector<std::vector<Cage>> chunks(scene.triangles.size() / kChunk + 1);
  parallel_chunks(scene.triangles.size(), [&](std::size_t first, std::size_t end) {
    std::vector<Cage>& cages = chunks[first / kChunk];
    cages.reserve(end - first);
    const TraceParams no_frame{};
    in_float::Kernel kernel = in_float::kernel_of(scene, no_frame, {});
    for (std::size_t t = first; t < end; ++t) {
      cage_part(patch_of(scene.choice, scene.triangles[t], kernel), {}, 0, static_cast<uint32_t>(t),
                cages);
    }
  });
  std::vector<Cage> cages;
  for (const std::vector<Cage>& chunk : chunks) {
    cages.insert(cages.end(), chunk.begin(), chunk.end());
  }
  return cages;
}

BakedScene bake_with_cages(const Mesh& mesh, const SurfaceChoice& choice) {
  BakedScene scene = bake(mesh, choice);
  scene.cages = bake_cages(scene);
  return scene;
}

}  // namespace trisect
