#include "app/mesh/made_normals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace trisect {
namespace {

using glm::dvec3;

double angle_at(const std::array<dvec3, 3>& p, std::size_t i) {
  const dvec3 a = p[(i + 1) % 3] - p[i];
  const dvec3 b = p[(i + 2) % 3] - p[i];
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// For each vertex the corners that meet there, as numbers 3 * triangle + corner.
class VertexFans {
 public:
  VertexFans(const std::vector<ModelTriangle>& triangles, std::size_t vertices)
      : begin_(vertices + 1, 0), corners_(triangles.size() * 3) {
    for (const ModelTriangle& t : triangles) {
      for (const uint32_t v : t.vertex) ++begin_[v + 1];
    }
    for (std::size_t v = 0; v < vertices; ++v) begin_[v + 1] += begin_[v];
    std::vector<uint32_t> end(begin_.begin(), begin_.end() - 1);
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      corners_[end[triangles[c / 3].vertex[c % 3]]++] = static_cast<uint32_t>(c);
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

class NormalMaker {
 public:
  NormalMaker(const std::vector<ModelTriangle>& triangles, const std::vector<dvec3>& positions,
              double crease_cosine)
      : triangles_(triangles), positions_(positions), crease_cosine_(crease_cosine) {
    made_.of_corner.resize(3 * triangles.size());
    faces_.reserve(triangles.size());
    for (const ModelTriangle& t : triangles) {
      faces_.push_back(glm::normalize(area_vector(points_of(t.vertex, positions))));
    }
    const VertexFans fans(triangles, positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) {
      add(fans.around(static_cast<uint32_t>(v)));
    }
  }

  MadeNormals take() { return std::move(made_); }

 private:
  // around: the corners at a vertex.
  void add(std::span<const uint32_t> around) {
    Connected connected = connected_faces(around);
    std::vector<dvec3> normals(around.size());
    std::vector<dvec3> weighted;
    std::vector<dvec3> sums(around.size(), dvec3(0.0));
    for (uint32_t i = 0; i < around.size(); ++i) {
      const uint32_t triangle = around[i] / 3;
      weighted.push_back(
          faces_[triangle] *
          angle_at(points_of(triangles_[triangle].vertex, positions_), around[i] % 3));
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
      normals[i] = length > 1e-9 ? sum / length : face;
    }
    number(around, normals);
  }

  // Gives each of the corners around a vertex its normal: equal ones are one.
  void number(std::span<const uint32_t> around, const std::vector<dvec3>& normals) {
    std::vector<uint32_t> order(around.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto before = [&](uint32_t a, uint32_t b) {
      const dvec3& m = normals[a];
      const dvec3& n = normals[b];
      return std::tie(m.x, m.y, m.z) < std::tie(n.x, n.y, n.z);
    };
    std::sort(order.begin(), order.end(), before);
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (k == 0 || before(order[k - 1], order[k])) made_.normals.push_back(normals[order[k]]);
      made_.of_corner[around[order[k]]] = static_cast<uint32_t>(made_.normals.size() - 1);
    }
  }

  Connected connected_faces(std::span<const uint32_t> around) const {
    struct Edge {
      uint32_t to;  // the other vertex
      uint32_t face;
    };
    std::vector<Edge> edges;
    for (uint32_t i = 0; i < around.size(); ++i) {
      const auto& vertex = triangles_[around[i] / 3].vertex;
      edges.push_back({vertex[(around[i] + 1) % 3], i});
      edges.push_back({vertex[(around[i] + 2) % 3], i});
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

  const std::vector<ModelTriangle>& triangles_;
  const std::vector<dvec3>& positions_;
  double crease_cosine_;
  std::vector<dvec3> faces_;
  MadeNormals made_;
};

}  // namespace

MadeNormals make_normals(const std::vector<ModelTriangle>& triangles,
                         const std::vector<dvec3>& positions, double crease_cosine) {
  return NormalMaker(triangles, positions, crease_cosine).take();
}

}  // namespace trisect
