#include "app/mesh/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "app/base/error.h"
#include "app/mesh/polygon.h"

namespace trisect {
namespace {

using glm::dvec3;

// A triangle whose corners are still indices into the file, and the welded positions of its
// corners.
struct Corners {
  std::array<ObjCorner, 3> corner;
  std::array<uint32_t, 3> welded;
};

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

// Angle-weighted normals, one for each corner: the mean over the faces around its vertex that lie
// within the crease angle of the corner's own face.
class WeldedNormals {
 public:
  WeldedNormals(const std::vector<Corners>& triangles, const std::vector<dvec3>& positions,
                double crease_cosine)
      : triangles_(triangles),
        positions_(positions),
        fans_(triangles, positions.size()),
        crease_cosine_(crease_cosine) {
    faces_.reserve(triangles.size());
    for (const Corners& t : triangles) {
      faces_.push_back(glm::normalize(area_vector(points_of(t.welded, positions))));
    }
  }

  [[nodiscard]] dvec3 at(std::size_t triangle, std::size_t corner) const {
    dvec3 sum(0.0);
    for (const uint32_t other : fans_.around(triangles_[triangle].welded[corner])) {
      const dvec3& face = faces_[other / 3];
      if (other / 3 != triangle && glm::dot(face, faces_[triangle]) < crease_cosine_) continue;
      sum += face * angle_at(points_of(triangles_[other / 3].welded, positions_), other % 3);
    }
    // Where the faces cancel out, as on the two sides of a sheet, the corner's own face decides.
    const double length = glm::length(sum);
    return length > 1e-9 ? sum / length : faces_[triangle];
  }

 private:
  const std::vector<Corners>& triangles_;
  const std::vector<dvec3>& positions_;
  VertexFans fans_;
  double crease_cosine_;
  std::vector<dvec3> faces_;
};

// Counts the edges of the report. An edge is a pair of welded positions.
void count_edges(const std::vector<Corners>& triangles, const Mesh& mesh, MeshReport& report) {
  struct Side {
    std::pair<uint32_t, uint32_t> edge;  // lower position first
    std::pair<uint32_t, uint32_t> normals;
    bool forward;
  };
  std::vector<Side> sides;
  sides.reserve(triangles.size() * 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      Side side{{triangles[t].welded[i], triangles[t].welded[j]},
                {mesh.triangles[t].normal[i], mesh.triangles[t].normal[j]},
                triangles[t].welded[i] < triangles[t].welded[j]};
      if (!side.forward) {
        std::swap(side.edge.first, side.edge.second);
        std::swap(side.normals.first, side.normals.second);
      }
      sides.push_back(side);
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.edge < b.edge; });
  // Files often hold normals in single precision: equal ones may differ in the last digit.
  const auto differ = [&](uint32_t a, uint32_t b) {
    return glm::distance(mesh.normals[a], mesh.normals[b]) > 1e-6;
  };
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].edge == sides[begin].edge) ++end;
    if (end - begin == 1) ++report.open_edges;
    if (end - begin > 2) ++report.non_manifold_edges;
    if (end - begin != 2) continue;
    const Side& a = sides[begin];
    const Side& b = sides[begin + 1];
    if (a.forward == b.forward) ++report.flipped_edges;
    if (differ(a.normals.first, b.normals.first) || differ(a.normals.second, b.normals.second)) {
      ++report.hard_edges;
    }
  }
}

}  // namespace

BuiltMesh build_mesh(const ObjFile& file, const std::string& name,
                     std::optional<double> crease_degrees) {
  BuiltMesh built;
  Mesh& mesh = built.mesh;
  MeshReport& report = built.report;
  const std::vector<uint32_t> welded = weld(file.positions);

  std::vector<Corners> triangles;
  std::size_t first = 0;
  for (const uint32_t size : file.sizes) {
    const std::span<const ObjCorner> polygon(file.corners.data() + first, size);
    first += size;
    std::vector<dvec3> points;
    for (const ObjCorner& corner : polygon) points.push_back(file.positions[corner.position]);
    for (const auto& cut : triangulate(points)) {
      const Corners t{{polygon[cut[0]], polygon[cut[1]], polygon[cut[2]]},
                      {welded[polygon[cut[0]].position], welded[polygon[cut[1]].position],
                       welded[polygon[cut[2]].position]}};
      if (degenerate(points_of(t.welded, file.positions))) {
        ++report.degenerate_dropped;
      } else {
        triangles.push_back(t);
      }
    }
  }
  if (triangles.empty()) throw InputError(name + ": every face has zero area.");

  // The file's normals at unit length. One of length zero cannot be used.
  std::vector<bool> usable(file.normals.size(), false);
  for (std::size_t i = 0; i < file.normals.size(); ++i) {
    // Scaled by the largest component first, or the squares of tiny and huge ones would leave the
    // range of double precision.
    const dvec3 size = glm::abs(file.normals[i]);
    const double scale = std::max({size.x, size.y, size.z});
    usable[i] = scale > 0.0 && !crease_degrees;
    mesh.normals.push_back(usable[i] ? glm::normalize(file.normals[i] / scale) : dvec3(0.0));
  }

  std::vector<uint32_t> number(file.positions.size(), ObjCorner::no_normal);
  const double cosine = crease_degrees ? std::cos(glm::radians(*crease_degrees)) : -2.0;
  std::optional<WeldedNormals> own;
  std::size_t from_file = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    MeshTriangle out{};
    const std::array<dvec3, 3> points = points_of(triangles[t].welded, file.positions);
    for (std::size_t i = 0; i < 3; ++i) {
      const uint32_t vertex = triangles[t].welded[i];
      if (number[vertex] == ObjCorner::no_normal) {
        number[vertex] = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.push_back(points[i]);
      }
      out.vertex[i] = number[vertex];
      const uint32_t normal = triangles[t].corner[i].normal;
      if (normal != ObjCorner::no_normal && usable[normal]) {
        out.normal[i] = normal;
        ++from_file;
      } else {
        if (!own) own.emplace(triangles, file.positions, cosine);
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
  count_edges(triangles, mesh, report);
  return built;
}

BuiltMesh build_mesh(std::span<const dvec3> positions, std::span<const dvec3> normals,
                     std::span<const uint32_t> triangles, std::optional<double> crease_degrees) {
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
  ObjFile polygons;
  polygons.positions.assign(positions.begin(), positions.end());
  polygons.normals.assign(normals.begin(), normals.end());
  polygons.sizes.assign(triangles.size() / 3, 3);
  polygons.corners.reserve(triangles.size());
  for (const uint32_t index : triangles) {
    expect(index < positions.size(),
           fmt::format("index {} names none of {} positions", index, positions.size()));
    polygons.corners.push_back({index, normals.empty() ? ObjCorner::no_normal : index});
  }
  return build_mesh(polygons, "mesh", crease_degrees);
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
  if (report.normals_behind > 0) {
    text += fmt::format(", {} corner normals that point behind their face", report.normals_behind);
  }
  return text;
}

}  // namespace trisect
