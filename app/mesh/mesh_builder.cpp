#include "app/mesh/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "app/base/error.h"
#include "app/mesh/edges.h"
#include "app/mesh/polygon.h"

namespace trisect {
namespace {

using glm::dvec3;

// A triangle whose corners are still indices into the model, and the welded positions of its
// corners.
struct Corners {
  std::array<PolygonCorner, 3> corner;
  std::array<uint32_t, 3> welded;
  uint32_t smoothing_group;
};

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

// The face normal with twice the triangle's area as its length.
dvec3 area_vector(const std::array<dvec3, 3>& p) {
  return glm::cross(p[1] - p[0], p[2] - p[0]);
}

std::array<dvec3, 3> points_of(const std::array<uint32_t, 3>& vertex,
                               const std::vector<dvec3>& positions) {
  return {positions[vertex[0]], positions[vertex[1]], positions[vertex[2]]};
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

double angle_at(const std::array<dvec3, 3>& p, std::size_t i) {
  const dvec3 a = p[(i + 1) % 3] - p[i];
  const dvec3 b = p[(i + 2) % 3] - p[i];
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// For each welded vertex the corners that meet there, as numbers 3 * triangle + corner.
class VertexFans {
 public:
  VertexFans(const std::vector<Corners>& triangles, std::size_t vertices)
      : begin_(vertices + 1, 0), corners_(triangles.size() * 3) {
    for (const Corners& t : triangles) {
      for (const uint32_t v : t.welded) ++begin_[v + 1];
    }
    for (std::size_t v = 0; v < vertices; ++v) begin_[v + 1] += begin_[v];
    std::vector<uint32_t> end(begin_.begin(), begin_.end() - 1);
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      corners_[end[triangles[c / 3].welded[c % 3]]++] = static_cast<uint32_t>(c);
    }
  }
  [[nodiscard]] std::span<const uint32_t> around(uint32_t vertex) const {
    return {corners_.data() + begin_[vertex], corners_.data() + begin_[vertex + 1]};
  }

 private:
  std::vector<uint32_t> begin_;
  std::vector<uint32_t> corners_;
};

// Which of the faces around a vertex are connected by edges: sets of numbers from 0 on.
class Connected {
 public:
  explicit Connected(std::size_t count) : root_(count) {
    for (std::size_t i = 0; i < count; ++i) root_[i] = static_cast<uint32_t>(i);
  }
  void join(uint32_t a, uint32_t b) { root_[set_of(b)] = set_of(a); }
  uint32_t set_of(uint32_t i) {
    while (root_[i] != i) i = root_[i] = root_[root_[i]];
    return i;
  }

 private:
  std::vector<uint32_t> root_;
};

// Angle-weighted normals, one for each corner, as build_mesh() describes them.
class MadeNormals {
 public:
  // crease_cosine: of the angle; less than -1 without one.
  MadeNormals(const std::vector<Corners>& triangles, const std::vector<dvec3>& positions,
              double crease_cosine)
      : triangles_(triangles),
        positions_(positions),
        crease_cosine_(crease_cosine),
        normals_(3 * triangles.size()) {
    faces_.reserve(triangles.size());
    for (const Corners& t : triangles) {
      faces_.push_back(glm::normalize(area_vector(points_of(t.welded, positions))));
    }
    const VertexFans fans(triangles, positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) {
      add(fans.around(static_cast<uint32_t>(v)));
    }
  }

  [[nodiscard]] const dvec3& at(std::size_t triangle, std::size_t corner) const {
    return normals_[3 * triangle + corner];
  }

 private:
  // around: the corners at a vertex.
  void add(std::span<const uint32_t> around) {
    Connected connected = connected_faces(around);
    std::vector<dvec3> weighted;
    std::vector<dvec3> sums(around.size(), dvec3(0.0));
    for (uint32_t i = 0; i < around.size(); ++i) {
      const uint32_t triangle = around[i] / 3;
      weighted.push_back(
          faces_[triangle] *
          angle_at(points_of(triangles_[triangle].welded, positions_), around[i] % 3));
      sums[connected.set_of(i)] += weighted[i];
    }
    for (uint32_t i = 0; i < around.size(); ++i) {
      const dvec3& face = faces_[around[i] / 3];
      dvec3 sum = sums[connected.set_of(i)];
      if (crease_cosine_ > -1.0) {
        sum = dvec3(0.0);
        for (uint32_t k = 0; k < around.size(); ++k) {
          const bool counts = k == i || (connected.set_of(k) == connected.set_of(i) &&
                                         !(glm::dot(faces_[around[k] / 3], face) < crease_cosine_));
          if (counts) sum += weighted[k];
        }
      }
      // Where the faces cancel out, as on the two sides of a sheet, the corner's own face decides.
      const double length = glm::length(sum);
      normals_[around[i]] = length > 1e-9 ? sum / length : face;
    }
  }

  Connected connected_faces(std::span<const uint32_t> around) const {
    struct Edge {
      uint32_t to;  // the other vertex
      uint32_t face;
    };
    std::vector<Edge> edges;
    for (uint32_t i = 0; i < around.size(); ++i) {
      const auto& welded = triangles_[around[i] / 3].welded;
      edges.push_back({welded[(around[i] + 1) % 3], i});
      edges.push_back({welded[(around[i] + 2) % 3], i});
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
      return std::pair(a.to, a.face) < std::pair(b.to, b.face);
    });
    Connected connected(around.size());
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      while (end < edges.size() && edges[end].to == edges[begin].to) ++end;
      if (end - begin != 2) continue;
      const uint32_t a = edges[begin].face;
      const uint32_t b = edges[begin + 1].face;
      const uint32_t group = triangles_[around[a] / 3].smoothing_group;
      if (group != 0 && group == triangles_[around[b] / 3].smoothing_group) connected.join(a, b);
    }
    return connected;
  }

  const std::vector<Corners>& triangles_;
  const std::vector<dvec3>& positions_;
  double crease_cosine_;
  std::vector<dvec3> faces_;
  std::vector<dvec3> normals_;
};

std::vector<Side> welded_sides(const std::vector<Corners>& triangles) {
  return sides_of(triangles.size(), [&](uint32_t t) -> const std::array<uint32_t, 3>& {
    return triangles[t].welded;
  });
}

// Counts the edges of the report.
void count_edges(const std::vector<Corners>& triangles, const Mesh& mesh, MeshReport& report) {
  // Files often hold normals in single precision: equal ones may differ in the last digit.
  const auto differ = [&](const Side& a, uint32_t end_of_a, const Side& b, uint32_t end_of_b) {
    const auto normal_at = [&](const Side& side, uint32_t end) {
      return mesh.normals[mesh.triangles[side.triangle].normal[(side.corner + end) % 3]];
    };
    return glm::distance(normal_at(a, end_of_a), normal_at(b, end_of_b)) > 1e-6;
  };
  for_edges(welded_sides(triangles), [&](std::span<const Side> sides) {
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
double volume_under(const Corners& t, const std::vector<dvec3>& positions, const dvec3& from) {
  const std::array<dvec3, 3> p = points_of(t.welded, positions);
  return glm::dot(glm::cross(p[0] - from, p[1] - from), p[2] - from);
}

// MeshOptions::repair. Returns how many triangles were turned around.
std::size_t repair_winding(std::vector<Corners>& triangles, const std::vector<dvec3>& positions) {
  struct Neighbour {
    uint32_t triangle;
    bool turned;  // has the opposite winding
  };
  std::vector<std::vector<Neighbour>> neighbours(triangles.size());
  std::vector<bool> is_open(triangles.size(), false);
  for_edges(welded_sides(triangles), [&](std::span<const Side> sides) {
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
          volume_under(triangles[t], positions, positions[triangles[first].welded[0]]);
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
      std::swap(triangles[t].welded[1], triangles[t].welded[2]);
      std::swap(triangles[t].corner[1], triangles[t].corner[2]);
    }
  }
  return count;
}

}  // namespace

BuiltMesh build_mesh(const PolygonModel& model, const std::string& name,
                     const MeshOptions& options) {
  BuiltMesh built;
  Mesh& mesh = built.mesh;
  MeshReport& report = built.report;
  const std::vector<uint32_t> welded =
      options.weld > 0.0 ? weld(model.positions, options.weld) : weld(model.positions);

  std::vector<Corners> triangles;
  std::size_t first = 0;
  for (std::size_t face = 0; face < model.sizes.size(); ++face) {
    const std::span<const PolygonCorner> polygon(model.corners.data() + first, model.sizes[face]);
    first += model.sizes[face];
    std::vector<uint32_t> places;
    places.reserve(polygon.size());
    for (const PolygonCorner& corner : polygon) places.push_back(welded[corner.position]);
    const std::vector<uint32_t> outline = outline_of(places);
    if (outline.size() < 3) {
      ++report.degenerate_dropped;
      continue;
    }
    std::vector<dvec3> points;
    points.reserve(outline.size());
    for (const uint32_t i : outline) points.push_back(model.positions[places[i]]);
    const uint32_t group = model.smoothing_groups.empty() ? 1 : model.smoothing_groups[face];
    for (const auto& cut : triangulate(points)) {
      Corners t{{}, {}, group};
      for (std::size_t i = 0; i < 3; ++i) {
        t.corner[i] = polygon[outline[cut[i]]];
        t.welded[i] = places[outline[cut[i]]];
      }
      if (degenerate(points_of(t.welded, model.positions))) {
        ++report.degenerate_dropped;
      } else {
        triangles.push_back(t);
      }
    }
  }
  if (triangles.empty()) throw InputError(name + ": every face has zero area.");
  if (options.repair) report.turned = repair_winding(triangles, model.positions);

  // The model's normals at unit length. One of length zero cannot be used.
  std::vector<bool> usable(model.normals.size(), false);
  for (std::size_t i = 0; i < model.normals.size(); ++i) {
    // Scaled by the largest component first, or the squares of tiny and huge ones would leave the
    // range of double precision.
    const dvec3 size = glm::abs(model.normals[i]);
    const double scale = std::max({size.x, size.y, size.z});
    usable[i] = scale > 0.0 && !options.crease_degrees;
    mesh.normals.push_back(usable[i] ? glm::normalize(model.normals[i] / scale) : dvec3(0.0));
  }

  std::vector<uint32_t> number(model.positions.size(), kNone);
  const double cosine =
      options.crease_degrees ? std::cos(glm::radians(*options.crease_degrees)) : -2.0;
  std::optional<MadeNormals> own;
  std::size_t from_file = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    MeshTriangle out{};
    const std::array<dvec3, 3> points = points_of(triangles[t].welded, model.positions);
    for (std::size_t i = 0; i < 3; ++i) {
      const uint32_t vertex = triangles[t].welded[i];
      if (number[vertex] == kNone) {
        number[vertex] = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.push_back(points[i]);
      }
      out.vertex[i] = number[vertex];
      const uint32_t normal = triangles[t].corner[i].normal;
      if (normal != PolygonCorner::no_normal && usable[normal]) {
        out.normal[i] = normal;
        ++from_file;
      } else {
        if (!own) own.emplace(triangles, model.positions, cosine);
        out.normal[i] = static_cast<uint32_t>(mesh.normals.size());
        mesh.normals.push_back(own->at(t, i));
      }
      if (glm::dot(mesh.normals[out.normal[i]], area_vector(points)) <= 0.0) {
        ++report.normals_behind;
      }
    }
    mesh.triangles.push_back(out);
  }

  report.triangles = mesh.triangles.size();
  report.vertices = mesh.positions.size();
  report.normals = from_file == 3 * mesh.triangles.size() ? NormalSource::file
                   : from_file == 0                       ? NormalSource::welded
                                                          : NormalSource::mixed;
  report.notes = model.notes;
  count_edges(triangles, mesh, report);
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
  return build_mesh(polygons, "mesh", options);
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
