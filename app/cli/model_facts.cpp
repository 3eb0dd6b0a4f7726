#include "app/cli/model_facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <span>

#include "app/bake/bake.h"
#include "app/bake/subpatch_bounds.h"
#include "app/base/error.h"
#include "app/base/interval.h"
#include "app/base/parallel_rows.h"
#include "app/cli/interrupt.h"
#include "app/mesh/bounds.h"
#include "app/mesh/edges.h"
#include "app/surface/patch_range.h"
#include "app/surface/surface_double.h"
#include "app/surface/to_double.h"

namespace trisect {
namespace {

using glm::dvec3;

void find_lean(const Mesh& mesh, ModelFacts& facts) {
  for (const MeshTriangle& t : mesh.triangles) {
    const auto& p = mesh.positions;
    const dvec3 face = glm::cross(p[t.vertex[1]] - p[t.vertex[0]], p[t.vertex[2]] - p[t.vertex[0]]);
    for (const uint32_t normal : t.normal) {
      const dvec3& n = mesh.normals[normal];
      const double lean =
          glm::degrees(std::atan2(glm::length(glm::cross(face, n)), glm::dot(face, n)));
      facts.largest_lean = std::max(facts.largest_lean, lean);
      facts.leaning += lean > kSteepLean ? 1 : 0;
    }
  }
}

SurfaceFacts surface_facts(const Mesh& mesh, const SurfaceChoice& choice, double radius) {
  const BakedScene scene = bake_with_subpatches(mesh, choice);
  const in_double::Shape shape = shape_of(choice);
  SurfaceFacts facts;
  facts.choice = choice;
  facts.device_bytes = device_bytes(scene);
  facts.parts = static_cast<std::size_t>(
      std::count_if(scene.subpatches.begin(), scene.subpatches.end(),
                    [](const SubpatchBounds& bounds) { return bounds.skip == 0; }));
  std::mutex mutex;
  parallel_chunks(scene.triangles.size(), kChunk, [&](std::size_t first, std::size_t end) {
    std::size_t folding = 0;
    double farthest = 0.0;
    for (std::size_t t = first; t < end; ++t) {
      const in_double::Triangle tri = to_double(scene.triangles[t]);
      bool folds = false;
      constexpr int parts = 4;
      for (int i = 0; i <= parts; ++i) {
        for (int k = 0; i + k <= parts; ++k) {
          const dvec3 w = dvec3(parts - i - k, i, k) / static_cast<double>(parts);
          const dvec3 n = in_double::geometric_normal(shape, tri, w);
          folds = folds || glm::dot(n, dvec3(tri.TriNormal)) < 0.0;
          farthest = std::max(farthest, glm::distance(in_double::surface_point(shape, tri, w),
                                                      in_double::base_point(tri, w)));
        }
      }
      folding += folds ? 1 : 0;
    }
    const std::scoped_lock lock(mutex);
    facts.folding += folding;
    facts.largest_displacement = std::max(facts.largest_displacement, farthest / radius);
  });
  return facts;
}

// The largest distance between the curves of two triangles along their common edge.
void find_crack(const Mesh& mesh, ModelFacts& facts) {
  const SurfaceChoice choice{SURFACE_PHONG, SurfaceChoice{}.alpha, SHELL_HEIGHT};
  BakedScene scene;
  try {
    scene = bake(mesh, choice);
  } catch (const InputError&) {
    // No triangle has a surface there.
    facts.without_height_shell = mesh.triangles.size();
    return;
  }
  const in_double::Shape shape = shape_of(choice);
  facts.without_height_shell = count_without_surface(scene);
  const std::vector<Side> sides = sides_of(
      mesh.triangles.size(),
      [&](uint32_t t) -> const std::array<uint32_t, 3>& { return mesh.triangles[t].vertex; });
  for_edges(sides, [&](std::span<const Side> edge) {
    if (edge.size() != 2) return;
    const auto point = [&](const Side& side, double s) {
      const double along = side.forward ? s : 1.0 - s;
      dvec3 w(0.0);
      w[static_cast<int>(side.corner)] = 1.0 - along;
      w[static_cast<int>((side.corner + 1) % 3)] = along;
      return in_double::surface_point(shape, to_double(scene.triangles[side.triangle]), w);
    };
    if (!has_surface(scene.triangles[edge[0].triangle])) return;
    if (!has_surface(scene.triangles[edge[1].triangle])) return;
    constexpr int parts = 10;
    for (int i = 1; i < parts; ++i) {
      const double s = static_cast<double>(i) / parts;
      const double crack = glm::distance(point(edge[0], s), point(edge[1], s));
      facts.largest_crack = std::max(facts.largest_crack, crack / facts.radius);
    }
  });
}

}  // namespace

ModelFacts facts_of(const Mesh& mesh, uint surface) {
  ModelFacts facts{};
  const Bounds bounds = bounds_of(mesh.positions);
  facts.low = bounds.low;
  facts.high = bounds.high;
  find_lean(mesh, facts);
  const double alpha = SurfaceChoice{}.alpha;
  const dvec3 centre = middle_of(bounds);
  for (const dvec3& p : mesh.positions) {
    facts.radius = std::max(facts.radius, glm::distance(p, centre));
  }
  stop_if_interrupted();
  facts.surface = surface_facts(mesh, {surface, alpha, SHELL_NORMAL}, facts.radius);
  stop_if_interrupted();
  find_crack(mesh, facts);
  return facts;
}

double moved_by_rounding(const Mesh& mesh, double alpha, double position, double normal) {
  if (std::isinf(position) || std::isinf(normal)) return kInfinity;
  double displacement = 0.0;  // over all edges, three times the largest
  double change = 0.0;
  for (const MeshTriangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const dvec3 edge = mesh.positions[t.vertex[j]] - mesh.positions[t.vertex[i]];
      const dvec3 turn = mesh.normals[t.normal[j]] - mesh.normals[t.normal[i]];
      displacement = std::max(displacement, std::abs(alpha * glm::dot(edge, turn)));
      change =
          std::max(change, std::abs(alpha) * (2.0 * position * (glm::length(turn) + 2.0 * normal) +
                                              2.0 * normal * glm::length(edge)));
    }
  }
  return position + (change + (displacement + change) * normal) / 3.0;
}

}  // namespace trisect
