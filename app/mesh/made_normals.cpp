#include "app/mesh/made_normals.h"

#include <algorithm>
#include <array>
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

// One of the faces around a vertex: its normal, and the same weighted by its angle there.
struct FaceNormal {
  dvec3 normal;
  dvec3 weighted;
};

// Faces around a vertex, by a tree of boxes around their normals: of those within an angle of a
// direction whole boxes are added up at once.
class FaceTree {
 public:
  explicit FaceTree(std::vector<FaceNormal> faces) : faces_(std::move(faces)) {
    add_box(0, static_cast<uint32_t>(faces_.size()));
  }

  // The sum of the weighted normals of faces whose normals' product with `face` is not less than
  // `cosine`.
  [[nodiscard]] dvec3 sum_within(const dvec3& face, double cosine) const {
    dvec3 sum(0.0);
    std::array<uint32_t, 64> waiting{};
    std::size_t count = 1;
    while (count > 0) {
      const Box& box = boxes_[waiting[--count]];
      const Counts counts = counted(box, face, cosine);
      if (counts == Counts::all) sum += box.sum;
      if (counts != Counts::some) continue;
      if (box.first_half != 0) {
        waiting[count++] = box.first_half;
        waiting[count++] = box.second_half;
        continue;
      }
      for (uint32_t k = box.begin; k < box.end; ++k) {
        if (!(glm::dot(faces_[k].normal, face) < cosine)) sum += faces_[k].weighted;
      }
    }
    return sum;
  }

 private:
  enum class Counts { none, some, all };

  struct Box {
    dvec3 low;
    dvec3 high;
    dvec3 sum;
    uint32_t begin;
    uint32_t end;
    uint32_t first_half = 0;  // 0 without halves
    uint32_t second_half = 0;
  };

  static Counts counted(const Box& box, const dvec3& face, double cosine) {
    // Equal normals have the same product to the bit.
    if (box.low == box.high) {
      return glm::dot(box.low, face) < cosine ? Counts::none : Counts::all;
    }
    const dvec3 a = box.low * face;
    const dvec3 b = box.high * face;
    constexpr double rounding = 1e-15;
    const auto sum = [](const dvec3& v) { return v.x + v.y + v.z; };
    if (sum(glm::max(a, b)) < cosine - rounding) return Counts::none;
    return sum(glm::min(a, b)) > cosine + rounding ? Counts::all : Counts::some;
  }

  uint32_t add_box(uint32_t begin, uint32_t end) {
    const auto index = static_cast<uint32_t>(boxes_.size());
    Box box{faces_[begin].normal, faces_[begin].normal, dvec3(0.0), begin, end};
    for (uint32_t k = begin; k < end; ++k) {
      box.low = glm::min(box.low, faces_[k].normal);
      box.high = glm::max(box.high, faces_[k].normal);
      box.sum += faces_[k].weighted;
    }
    boxes_.push_back(box);
    constexpr uint32_t in_leaf = 8;
    if (end - begin <= in_leaf) return index;
    const dvec3 size = box.high - box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const uint32_t middle = begin + (end - begin) / 2;
    const auto at = [&](uint32_t k) { return faces_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(begin), at(middle), at(end), [&](const FaceNormal& m, const FaceNormal& n) {
      return m.normal[axis] < n.normal[axis];
    });
    const uint32_t first_half = add_box(begin, middle);
    const uint32_t second_half = add_box(middle, end);
    boxes_[index].first_half = first_half;
    boxes_[index].second_half = second_half;
    return index;
  }

  std::vector<FaceNormal> faces_;
  std::vector<Box> boxes_;
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
    std::vector<dvec3> within;
    if (crease_cosine_ > -1.0) within = sums_within_crease(around, weighted, connected);
    for (uint32_t i = 0; i < around.size(); ++i) {
      const dvec3& face = faces_[around[i] / 3];
      const dvec3 sum = within.empty() ? sums[connected.set_of(i)] : within[i];
      // Where the faces cancel out, as on the two sides of a sheet, the corner's own face decides.
      const double length = glm::length(sum);
      normals[i] = length > 1e-9 ? sum / length : face;
    }
    number(around, normals);
  }

  // For each of the faces around a vertex the sum of those that are connected with it and do not
  // meet it at more than the crease's angle.
  std::vector<dvec3> sums_within_crease(std::span<const uint32_t> around,
                                        const std::vector<dvec3>& weighted,
                                        Connected& connected) const {
    std::vector<uint32_t> order(around.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
      return std::pair(connected.set_of(a), a) < std::pair(connected.set_of(b), b);
    });
    std::vector<dvec3> sums(around.size(), dvec3(0.0));
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
      const uint32_t set = connected.set_of(order[begin]);
      while (end < order.size() && connected.set_of(order[end]) == set) ++end;
      const std::span<const uint32_t> members(order.data() + begin, end - begin);
      if (members.size() > kMostByPairs) {
        add_by_tree(members, around, weighted, sums);
      } else {
        add_by_pairs(members, around, weighted, sums);
      }
    }
    return sums;
  }

  // More faces than that are not tried each with each.
  static constexpr std::size_t kMostByPairs = 512;

  void add_by_pairs(std::span<const uint32_t> members, std::span<const uint32_t> around,
                    const std::vector<dvec3>& weighted, std::vector<dvec3>& sums) const {
    for (const uint32_t i : members) {
      const dvec3& face = faces_[around[i] / 3];
      for (const uint32_t k : members) {
        const bool counts = k == i || !(glm::dot(faces_[around[k] / 3], face) < crease_cosine_);
        if (counts) sums[i] += weighted[k];
      }
    }
  }

  void add_by_tree(std::span<const uint32_t> members, std::span<const uint32_t> around,
                   const std::vector<dvec3>& weighted, std::vector<dvec3>& sums) const {
    std::vector<FaceNormal> faces;
    faces.reserve(members.size());
    for (const uint32_t i : members) faces.push_back({faces_[around[i] / 3], weighted[i]});
    const FaceTree tree(std::move(faces));
    for (const uint32_t i : members) {
      const dvec3& face = faces_[around[i] / 3];
      sums[i] = tree.sum_within(face, crease_cosine_);
      // Its own counts, whatever rounding makes of the product of a unit vector with itself.
      if (glm::dot(face, face) < crease_cosine_) sums[i] += weighted[i];
    }
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
