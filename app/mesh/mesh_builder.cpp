#include "app/mesh/mesh_builder.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "app/base/error.h"
#include "app/mesh/edges.h"
#include "app/mesh/made_normals.h"
#include "app/mesh/polygon.h"

namespace trisect {
namespace {

using glm::dvec3;

constexpr uint32_t kNone = 0xffffffffU;

struct PositionHash {
  std::size_t operator()(const dvec3& p) const {
    std::size_t hash = 0;
    for (int i = 0; i < 3; ++i) {
      hash = (hash ^ std::hash<double>()(p[i])) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 29U;
    }
    return hash;
  }
};

// For each position the index of the first one that is equal to it (0 and -0 are equal).
std::vector<uint32_t> weld(const std::vector<dvec3>& positions) {
  std::unordered_map<dvec3, uint32_t, PositionHash> first;
  first.reserve(positions.size());
  std::vector<uint32_t> welded;
  welded.reserve(positions.size());
  for (const dvec3& position : positions) {
    const auto next = static_cast<uint32_t>(welded.size());
    welded.push_back(first.try_emplace(position, next).first->second);
  }
  return welded;
}

// For each position the index of the first one that stands for others and is no farther than
// `distance` > 0.
std::vector<uint32_t> weld(const std::vector<dvec3>& positions, double distance) {
  // Those that stand for others, by cells of a grid.
  std::unordered_map<dvec3, std::vector<uint32_t>, PositionHash> cells;
  std::vector<uint32_t> welded;
  welded.reserve(positions.size());
  for (const dvec3& position : positions) {
    const dvec3 cell = glm::floor(position / distance);
    uint32_t found = kNone;
    for (int i = 0; i < 27; ++i) {
      const auto near = cells.find(cell + dvec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
      if (near == cells.end()) continue;
      for (const uint32_t other : near->second) {
        if (other < found && glm::distance(positions[other], position) <= distance) found = other;
      }
    }
    if (found == kNone) {
      found = static_cast<uint32_t>(welded.size());
      cells[cell].push_back(found);
    }
    welded.push_back(found);
  }
  return welded;
}

// The corners of a polygon, by their numbers, without those at the place of the one before and
// without spikes, in which the outline goes back the way that it came.
std::vector<uint32_t> outline_of(std::span<const uint32_t> welded) {
  std::vector<uint32_t> kept;
  const auto at = [&](std::size_t i) { return welded[kept[i]]; };
  for (uint32_t i = 0; i < welded.size(); ++i) {
    kept.push_back(i);
    while (true) {
      const std::size_t n = kept.size();
      if (n >= 2 && at(n - 1) == at(n - 2)) {
        kept.pop_back();
      } else if (n >= 3 && at(n - 1) == at(n - 3)) {
        kept.resize(n - 2);
      } else {
        break;
      }
    }
  }
  // The same around the first corner.
  std::size_t first = 0;
  while (kept.size() - first >= 2) {
    const std::size_t last = kept.size() - 1;
    if (at(last) == at(first)) {
      kept.pop_back();
    } else if (last - first >= 2 && at(last - 1) == at(first)) {
      kept.resize(last - 1);
    } else if (last - first >= 2 && at(last) == at(first + 1)) {
      kept.pop_back();
      ++first;
    } else {
      break;
    }
  }
  kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(first));
  return kept;
}

// Whether a triangle has no area up to rounding: its height over the longest edge is less than
// eight units in the last place of that edge. A triangle whose squared edges overflow does not
// count: bake() refuses such a model with a message about its size.
bool degenerate(const std::array<dvec3, 3>& p) {
  const double area = glm::length(area_vector(p));
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec3 edge = p[(i + 1) % 3] - p[i];
    longest = std::max(longest, glm::dot(edge, edge));
  }
  constexpr double ulps = 8.0 * 2.220446049250313e-16;
  return area <= ulps * longest && std::isfinite(longest);
}

template <typename Triangles>
std::vector<Side> sides_between(const Triangles& triangles) {
  return sides_of(triangles.size(), [&](uint32_t t) -> const std::array<uint32_t, 3>& {
    return triangles[t].vertex;
  });
}

// Counts the edges of the report.
void count_edges(const Mesh& mesh, MeshReport& report) {
  const auto differ = [&](const Side& a, uint32_t end_of_a, const Side& b, uint32_t end_of_b) {
    const auto normal_at = [&](const Side& side, uint32_t end) {
      return mesh.normals[mesh.triangles[side.triangle].normal[(side.corner + end) % 3]];
    };
    return glm::distance(normal_at(a, end_of_a), normal_at(b, end_of_b)) > kSameNormal;
  };
  for_edges(sides_between(mesh.triangles), [&](std::span<const Side> sides) {
    if (sides.size() == 1) ++report.open_edges;
    if (sides.size() > 2) ++report.non_manifold_edges;
    if (sides.size() != 2) return;
    const Side& a = sides[0];
    const Side& b = sides[1];
    const bool same_way = a.forward == b.forward;
    if (same_way) ++report.flipped_edges;
    if (differ(a, 0, b, same_way ? 0 : 1) || differ(a, 1, b, same_way ? 1 : 0)) ++report.hard_edges;
  });
}

// Six times the volume under a triangle, seen from a point.
double volume_under(const ModelTriangle& t, const std::vector<dvec3>& positions,
                    const dvec3& from) {
  const std::array<dvec3, 3> p = points_of(t.vertex, positions);
  return glm::dot(glm::cross(p[0] - from, p[1] - from), p[2] - from);
}

// MeshOptions::repair. Returns how many triangles were turned around.
std::size_t repair_winding(std::vector<ModelTriangle>& triangles,
                           const std::vector<dvec3>& positions) {
  struct Neighbour {
    uint32_t triangle;
    bool turned;  // has the opposite winding
  };
  std::vector<std::vector<Neighbour>> neighbours(triangles.size());
  std::vector<bool> is_open(triangles.size(), false);
  for_edges(sides_between(triangles), [&](std::span<const Side> sides) {
    if (sides.size() == 2) {
      const bool turned = sides[0].forward == sides[1].forward;
      neighbours[sides[0].triangle].push_back({sides[1].triangle, turned});
      neighbours[sides[1].triangle].push_back({sides[0].triangle, turned});
      return;
    }
    for (const Side& side : sides) is_open[side.triangle] = true;
  });
  std::vector<bool> seen(triangles.size(), false);
  std::vector<bool> turned(triangles.size(), false);
  std::size_t count = 0;
  for (uint32_t first = 0; first < triangles.size(); ++first) {
    if (seen[first]) continue;
    // All that hangs together with it.
    std::vector<uint32_t> part{first};
    seen[first] = true;
    bool closed = true;
    double volume = 0.0;
    std::size_t turned_in_part = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const uint32_t t = part[i];
      closed = closed && !is_open[t];
      const double under =
          volume_under(triangles[t], positions, positions[triangles[first].vertex[0]]);
      volume += turned[t] ? -under : under;
      turned_in_part += turned[t] ? 1 : 0;
      for (const Neighbour& neighbour : neighbours[t]) {
        if (seen[neighbour.triangle]) continue;
        seen[neighbour.triangle] = true;
        turned[neighbour.triangle] = turned[t] != neighbour.turned;
        part.push_back(neighbour.triangle);
      }
    }
    const bool inside_out = closed ? volume < 0.0 : 2 * turned_in_part > part.size();
    for (const uint32_t t : part) {
      if (turned[t] == inside_out) continue;
      ++count;
      std::swap(triangles[t].vertex[1], triangles[t].vertex[2]);
      std::swap(triangles[t].normal[1], triangles[t].normal[2]);
    }
  }
  return count;
}

// Frees a vector that is no longer needed: a model's are as large as the mesh.
template <typename Item>
void release(std::vector<Item>& items) {
  items = std::vector<Item>();
}

// The triangles of all polygons, but those without area, which `dropped` counts. welded: for each
// position the one that stands for it. colors: gets those of the triangles, if the model has any.
std::vector<ModelTriangle> triangles_of(const PolygonModel& model,
                                        const std::vector<uint32_t>& welded, std::size_t& dropped,
                                        std::vector<glm::vec3>& colors) {
  std::size_t count = 0;
  for (const uint32_t size : model.sizes) count += size - 2;
  std::vector<ModelTriangle> triangles;
  triangles.reserve(count);
  std::vector<uint32_t> places;
  std::vector<dvec3> points;
  std::size_t first = 0;
  for (std::size_t face = 0; face < model.sizes.size(); ++face) {
    const std::span<const PolygonCorner> polygon(model.corners.data() + first, model.sizes[face]);
    first += model.sizes[face];
    places.clear();
    for (const PolygonCorner& corner : polygon) places.push_back(welded[corner.position]);
    const std::vector<uint32_t> outline = outline_of(places);
    if (outline.size() < 3) {
      ++dropped;
      continue;
    }
    points.clear();
    for (const uint32_t i : outline) points.push_back(model.positions[places[i]]);
    const uint32_t group = model.smoothing_groups.empty() ? 1 : model.smoothing_groups[face];
    for (const auto& cut : triangulate(points)) {
      ModelTriangle t{{}, {}, group};
      for (std::size_t i = 0; i < 3; ++i) {
        t.normal[i] = polygon[outline[cut[i]]].normal;
        t.vertex[i] = places[outline[cut[i]]];
      }
      if (degenerate(points_of(t.vertex, model.positions))) {
        ++dropped;
      } else {
        triangles.push_back(t);
        if (!model.colors.empty()) colors.push_back(model.colors[face]);
      }
    }
  }
  return triangles;
}

// The positions that triangles use, in the order in which they come; the triangles then name those.
std::vector<dvec3> used_positions(const std::vector<dvec3>& positions,
                                  std::vector<ModelTriangle>& triangles) {
  std::vector<dvec3> used;
  std::vector<uint32_t> number(positions.size(), kNone);
  for (ModelTriangle& t : triangles) {
    for (uint32_t& vertex : t.vertex) {
      if (number[vertex] == kNone) {
        number[vertex] = static_cast<uint32_t>(used.size());
        used.push_back(positions[vertex]);
      }
      vertex = number[vertex];
    }
  }
  return used;
}

// The model's normals at unit length, 0 for one of length zero, which cannot be used.
std::vector<dvec3> unit_normals(std::vector<dvec3> normals) {
  for (dvec3& normal : normals) {
    // Scaled by the largest component first, or the squares of tiny and huge ones would leave the
    // range of double precision.
    const dvec3 size = glm::abs(normal);
    const double scale = std::max({size.x, size.y, size.z});
    normal = scale > 0.0 ? glm::normalize(normal / scale) : dvec3(0.0);
  }
  return normals;
}

// Gives corners whose normal is none or of length zero one of their own, and all of them with a
// crease. Returns how many the model had.
std::size_t complete_normals(std::vector<ModelTriangle>& triangles, Mesh& mesh,
                             const std::optional<double>& crease_degrees) {
  const auto has_normal = [&](uint32_t normal) {
    return !crease_degrees && normal != PolygonCorner::no_normal &&
           mesh.normals[normal] != dvec3(0.0);
  };
  std::size_t from_model = 0;
  for (const ModelTriangle& t : triangles) {
    from_model +=
        static_cast<std::size_t>(std::count_if(t.normal.begin(), t.normal.end(), has_normal));
  }
  if (from_model == 3 * triangles.size()) return from_model;
  if (from_model == 0) release(mesh.normals);
  const double cosine = crease_degrees ? std::cos(glm::radians(*crease_degrees)) : -2.0;
  const MadeNormals made = make_normals(triangles, mesh.positions, cosine);
  const auto first = static_cast<uint32_t>(mesh.normals.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      uint32_t& normal = triangles[t].normal[i];
      if (from_model == 0 || !has_normal(normal)) normal = first + made.of_corner[3 * t + i];
    }
  }
  mesh.normals.insert(mesh.normals.end(), made.normals.begin(), made.normals.end());
  return from_model;
}

}  // namespace

BuiltMesh build_mesh(PolygonModel model, const std::string& name, const MeshOptions& options) {
  BuiltMesh built;
  Mesh& mesh = built.mesh;
  MeshReport& report = built.report;
  std::vector<uint32_t> welded =
      options.weld > 0.0 ? weld(model.positions, options.weld) : weld(model.positions);
  std::vector<ModelTriangle> triangles =
      triangles_of(model, welded, report.degenerate_dropped, mesh.colors);
  if (triangles.empty()) throw InputError(name + ": every face has zero area.");
  release(welded);
  release(model.corners);
  release(model.sizes);
  release(model.smoothing_groups);
  release(model.colors);
  mesh.positions = used_positions(model.positions, triangles);
  release(model.positions);
  if (options.repair) report.turned = repair_winding(triangles, mesh.positions);
  mesh.normals = unit_normals(std::move(model.normals));
  const std::size_t from_file = complete_normals(triangles, mesh, options.crease_degrees);

  mesh.triangles.reserve(triangles.size());
  for (const ModelTriangle& t : triangles) {
    mesh.triangles.push_back({t.vertex, t.normal});
    const dvec3 face = area_vector(points_of(t.vertex, mesh.positions));
    for (const uint32_t normal : t.normal) {
      if (glm::dot(mesh.normals[normal], face) <= 0.0) ++report.normals_behind;
    }
  }
  release(triangles);
  malloc_trim(0);  // what is free between what is used: as much as the mesh

  report.triangles = mesh.triangles.size();
  report.colored = static_cast<std::size_t>(
      std::count_if(mesh.colors.begin(), mesh.colors.end(),
                    [](const glm::vec3& color) { return color.x >= 0.0F; }));
  if (report.colored == 0) release(mesh.colors);
  report.vertices = mesh.positions.size();
  report.normals = from_file == 3 * mesh.triangles.size() ? NormalSource::file
                   : from_file == 0                       ? NormalSource::welded
                                                          : NormalSource::mixed;
  report.notes = std::move(model.notes);
  count_edges(mesh, report);
  return built;
}

BuiltMesh build_mesh(std::span<const dvec3> positions, std::span<const dvec3> normals,
                     std::span<const uint32_t> triangles, const MeshOptions& options) {
  const auto expect = [](bool holds, const std::string& otherwise) {
    if (!holds) throw InputError("mesh: " + otherwise + ".");
  };
  const auto is_finite = [](const dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  expect(!triangles.empty(), "it has no triangles");
  expect(triangles.size() % 3 == 0,
         fmt::format("{} indices are not three for each triangle", triangles.size()));
  expect(normals.empty() || normals.size() == positions.size(),
         fmt::format("{} normals are not one for each of {} positions", normals.size(),
                     positions.size()));
  expect(std::all_of(positions.begin(), positions.end(), is_finite), "a position is not finite");
  expect(std::all_of(normals.begin(), normals.end(), is_finite), "a normal is not finite");
  PolygonModel polygons;
  polygons.positions.assign(positions.begin(), positions.end());
  polygons.normals.assign(normals.begin(), normals.end());
  polygons.sizes.assign(triangles.size() / 3, 3);
  polygons.corners.reserve(triangles.size());
  for (const uint32_t index : triangles) {
    expect(index < positions.size(),
           fmt::format("index {} names none of {} positions", index, positions.size()));
    polygons.corners.push_back({index, normals.empty() ? PolygonCorner::no_normal : index});
  }
  return build_mesh(std::move(polygons), "mesh", options);
}

std::string describe(const MeshReport& report) {
  const char* normals = report.normals == NormalSource::file ? "from the file"
                        : report.normals == NormalSource::welded
                            ? "angle-weighted over welded vertices"
                            : "from the file where it has them, angle-weighted elsewhere";
  std::string text = fmt::format(
      "{} triangles, {} vertices, normals {}, {} degenerate triangles dropped, {} hard "
      "edges, {} open edges, {} non-manifold edges",
      report.triangles, report.vertices, normals, report.degenerate_dropped, report.hard_edges,
      report.open_edges, report.non_manifold_edges);
  if (report.flipped_edges > 0) {
    text += fmt::format(", {} edges between triangles of opposite winding", report.flipped_edges);
  }
  if (report.turned > 0) text += fmt::format(", {} triangles turned around", report.turned);
  if (report.normals_behind > 0) {
    text += fmt::format(", {} corner normals that point behind their face", report.normals_behind);
  }
  for (const std::string& note : report.notes) text += ", " + note;
  return text;
}

}  // namespace trisect
