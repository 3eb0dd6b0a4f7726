#include "app/tessellation/flat_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "app/base/error.h"
#include "app/base/max_propagating_nan.h"
#include "app/base/parallel_rows.h"
#include "app/mesh/edges.h"
#include "app/surface/patch_range.h"
#include "app/tessellation/chord_bound.h"
#include "app/tessellation/surface_vertices.h"

namespace trisect {
namespace {

using glm::dvec3;

// A flat triangle in the making.
struct Piece {
  uint32_t patch = 0;
  std::array<PieceCorner, 3> corner{};
  double off = 0.0;       // how far its corners are off the patch's own surface
  double chord = -1.0;    // chord_bound(); not known yet
  double expected = 1.0;  // how many it will take, roughly and rather fewer
  uint32_t halved = 0;    // its edges that are to be: bit i for that from corner i to the next

  [[nodiscard]] double bound() const { return chord + off; }
};

CornerWeights weights_of(const Piece& piece) {
  return {piece.corner[0].weights, piece.corner[1].weights, piece.corner[2].weights};
}

[[noreturn]] void too_many() {
  throw InputError(
      fmt::format("the surface would take more than {} million triangles: ask for fewer "
                  "or for a larger error.",
                  kMostFlatTriangles / 1'000'000));
}

// Bound and edges of pieces. The functions may be called from several threads.
class PieceBounds {
 public:
  PieceBounds(const BakedScene& scene, const SurfaceVertices& vertices)
      : scene_(scene),
        vertices_(vertices),
        // No point of the surface is farther from the scene's origin. Some hundred roundings make a
        // position; the rest is for those of sigma, which grow where it is steep.
        rounding_(gamma_double(900) * (glm::length(scene.origin) +
                                       (3.0 + 2.0 * std::abs(scene.choice.alpha)) * scene.extent)) {
  }

  // Sets `off` and `chord`.
  void measure(Piece& piece) const {
    piece.off = 0.0;
    for (const PieceCorner& corner : piece.corner) {
      const dvec3 own = vertices_.surface_point(piece.patch, corner.weights);
      max_propagating_nan(piece.off, glm::distance(own, vertices_.position(corner.vertex)));
    }
    piece.off = std::isnan(piece.off) ? kInfinity : piece.off + rounding_;
    piece.chord = chord_bound(scene_.choice, patch_of(piece), weights_of(piece));
  }

  // How far the surface beside each edge is from it: at a third and two thirds of the way, for a
  // cubic that is on the line at both is the line.
  [[nodiscard]] std::array<double, 3> bends(const Piece& piece) const {
    std::array<double, 3> bend{};
    for (std::size_t i = 0; i < 3; ++i) {
      const PieceCorner& a = piece.corner[i];
      const PieceCorner& b = piece.corner[(i + 1) % 3];
      for (const double t : {1.0 / 3.0, 2.0 / 3.0}) {
        const dvec3 point =
            vertices_.surface_point(piece.patch, a.weights * (1.0 - t) + b.weights * t);
        const dvec3 chord =
            vertices_.position(a.vertex) * (1.0 - t) + vertices_.position(b.vertex) * t;
        bend[i] = std::max(bend[i], glm::distance(point, chord));
      }
    }
    return bend;
  }

  // The edges to halve for a bend of `error`: the most bent one, and where much is missing those
  // that come near it. If none is bent for what the bound says the piece has its bend inside, or
  // the bound is far from the truth: then the longest, and so in a sliver, which other edges would
  // make thinner and thinner. None that are shorter than a quarter of `error`. Lengths are those in
  // the base triangle.
  [[nodiscard]] uint32_t edges_to_halve(const Piece& piece, std::array<double, 3> bend,
                                        double error) const {
    const std::array<dvec3, 3> T = corners_of(patch_of(piece), weights_of(piece)).T;
    std::array<double, 3> length{};
    for (std::size_t i = 0; i < 3; ++i) {
      length[i] = glm::distance(T[i], T[(i + 1) % 3]);
      if (length[i] < 0.25 * error) length[i] = bend[i] = 0.0;
    }
    const double longest = longest_of({T[1] - T[0], T[2] - T[1], T[0] - T[2]});
    const double height = glm::length(glm::cross(T[1] - T[0], T[2] - T[0])) / longest;
    const bool by_bend =
        height > longest / 16.0 && *std::max_element(bend.begin(), bend.end()) > 0.1 * piece.chord;
    const std::array<double, 3>& by = by_bend ? bend : length;
    const double most = *std::max_element(by.begin(), by.end());
    // Halving all three quarters the bound. Up to twice the error one edge is often enough: a tenth
    // fewer triangles on the models here.
    const double near = piece.chord > 2.0 * error ? 0.7 * most : most;
    uint32_t edges = 0;
    for (uint32_t i = 0; i < 3; ++i) {
      if (by[i] > 0.0 && by[i] >= near) edges |= 1U << i;
    }
    return edges;
  }

 private:
  [[nodiscard]] Patch patch_of(const Piece& piece) const {
    return trisect::patch_of(scene_.choice.shell, scene_.triangles[piece.patch]);
  }

  const BakedScene& scene_;
  const SurfaceVertices& vertices_;
  double rounding_;
};

// Calls work(piece) for each, on all cores; false if progress said stop.
template <typename Work>
bool for_pieces(std::vector<Piece>& pieces, const Work& work, const FractionProgress& progress) {
  const auto chunk = [&](uint32_t number) {
    const std::size_t first = number * kChunk;
    const std::size_t end = std::min(first + kChunk, pieces.size());
    for (std::size_t k = first; k < end; ++k) work(pieces[k]);
  };
  const auto chunks = static_cast<uint32_t>((pieces.size() + kChunk - 1) / kChunk);
  return parallel_rows(chunks, chunk, [&](uint32_t done) {
    return may_go_on(progress, static_cast<double>(done) / chunks);
  });
}

FlatMesh mesh_of(const std::vector<Piece>& pieces, SurfaceVertices& vertices, double error) {
  FlatMesh flat;
  flat.triangles.reserve(pieces.size());
  flat.patches.reserve(pieces.size());
  for (const Piece& piece : pieces) {
    flat.triangles.emplace_back(piece.corner[0].vertex, piece.corner[1].vertex,
                                piece.corner[2].vertex);
    flat.patches.push_back(piece.patch);
    flat.bound = std::max(flat.bound, piece.bound());
    flat.off = std::max(flat.off, piece.off);
    flat.beyond_error += piece.bound() > error ? 1 : 0;
  }
  flat.positions = vertices.take_positions();
  flat.normals = vertices.take_normals();
  return flat;
}

// The patches as pieces.
std::vector<Piece> whole_patches(std::size_t count, SurfaceVertices& vertices) {
  std::vector<Piece> pieces(count);
  for (uint32_t t = 0; t < count; ++t) {
    pieces[t].patch = t;
    const CornerWeights weights = corner_weights(kWholeTriangle);
    for (std::size_t k = 0; k < 3; ++k) {
      pieces[t].corner[k] = {vertices.at_corner(t, k), weights[k]};
    }
  }
  return pieces;
}

// Divides edges until every piece is close enough.
class Refinement {
 public:
  Refinement(const Mesh& mesh, const BakedScene& scene, double error)
      : vertices_(mesh, scene), bounds_(scene, vertices_), error_(error) {
    pieces_ = whole_patches(scene.triangles.size(), vertices_);
  }

  enum class Round { divided, nothing_left, stopped };

  Round refine(const FractionProgress& progress) {
    const auto look = [this](Piece& piece) {
      if (piece.chord < 0.0) examine(piece);
    };
    if (!for_pieces(pieces_, look, part_of(progress, done_, done_))) return Round::stopped;
    halved_.clear();
    double expected = 0.0;
    for (const Piece& piece : pieces_) {
      expected += piece.expected;
      for (uint32_t i = 0; i < 3; ++i) {
        if ((piece.halved >> i & 1U) != 0) halved_.insert(edge_of(piece, i));
      }
    }
    if (halved_.empty()) return Round::nothing_left;
    if (expected > static_cast<double>(kMostFlatTriangles)) too_many();
    std::vector<Piece> divided;
    divided.reserve(pieces_.size() + halved_.size() * 2);
    for (const Piece& piece : pieces_) {
      divide(piece, divided);
      if (divided.size() > kMostFlatTriangles) too_many();
    }
    pieces_ = std::move(divided);
    vertices_.forget_edges();
    const auto count = static_cast<double>(pieces_.size());
    // Of teapot, torus and saddle to 1e-3 and 1e-5 there came 2.9 to 3.2 times as many.
    if (count < expected) whole_ = 3.0 * expected;
    done_ = std::clamp(count / whole_, done_, 1.0);
    return may_go_on(progress, done_) ? Round::divided : Round::stopped;
  }

  FlatMesh mesh() { return mesh_of(pieces_, vertices_, error_); }

 private:
  void examine(Piece& piece) const {
    bounds_.measure(piece);
    if (!(piece.bound() > error_)) return;
    // No division makes up for corners that are off: it need not be finer than those are.
    const double enough =
        std::isinf(piece.off) ? error_ : std::max(error_ - piece.off, 0.25 * piece.off);
    if (!(piece.chord > enough)) return;
    const std::array<double, 3> bend = bounds_.bends(piece);
    piece.halved = bounds_.edges_to_halve(piece, bend, enough);
    // Bent in all directions, into as many as the bend is larger than the error; in one, their
    // root.
    const auto [least, most] = std::minmax_element(bend.begin(), bend.end());
    piece.expected = std::max(1.0, std::sqrt(*most * std::max(*least, enough)) / enough);
  }

  // The edge from corner i.
  [[nodiscard]] uint64_t edge_of(const Piece& piece, uint32_t i) const {
    return vertices_.edge(piece.corner[i], piece.corner[(i + 1) % 3]);
  }

  // Adds the pieces that are left when the edges in halved_ are.
  void divide(const Piece& piece, std::vector<Piece>& divided) {
    std::array<bool, 3> halved{};
    for (uint32_t i = 0; i < 3; ++i) halved[i] = halved_.count(edge_of(piece, i)) > 0;
    const auto count = std::count(halved.begin(), halved.end(), true);
    if (count == 0) {
      divided.push_back(piece);
      return;
    }
    // Corners 0 to 2, and the middles of the edges from them, 3 to 5, turned so that the only
    // halved edge is the first, or the only other one the last.
    const uint32_t turn = count == 1   ? first_of(halved, true)
                          : count == 2 ? (first_of(halved, false) + 1) % 3
                                       : 0;
    std::array<PieceCorner, 6> corner{};
    for (std::size_t k = 0; k < 3; ++k) corner[k] = piece.corner[(k + turn) % 3];
    for (std::size_t k = 0; k < 3; ++k) {
      if (!halved[(k + turn) % 3]) continue;
      const PieceCorner& a = corner[k];
      const PieceCorner& b = corner[(k + 1) % 3];
      corner[k + 3] = {vertices_.between(piece.patch, a, b, 1).first,
                       (a.weights + b.weights) * 0.5};
    }
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      divided.push_back({piece.patch, {corner[a], corner[b], corner[c]}});
    };
    if (count == 1) {
      add(0, 3, 2);
      add(3, 1, 2);
      return;
    }
    add(3, 1, 4);
    if (count == 3) {
      add(0, 3, 5);
      add(5, 4, 2);
      add(3, 4, 5);
      return;
    }
    const auto distance = [&](std::size_t a, std::size_t b) {
      return glm::distance(vertices_.position(corner[a].vertex),
                           vertices_.position(corner[b].vertex));
    };
    if (distance(0, 4) < distance(3, 2)) {
      add(0, 3, 4);
      add(0, 4, 2);
    } else {
      add(0, 3, 2);
      add(3, 4, 2);
    }
  }

  static uint32_t first_of(const std::array<bool, 3>& values, bool value) {
    return static_cast<uint32_t>(std::find(values.begin(), values.end(), value) - values.begin());
  }

  SurfaceVertices vertices_;
  PieceBounds bounds_;
  double error_;
  std::vector<Piece> pieces_;
  std::unordered_set<uint64_t> halved_;
  double whole_ = 1.0;  // pieces that it will be
  double done_ = 0.0;
};

// Divides patches into n x n pieces.
class EvenDivision {
 public:
  EvenDivision(SurfaceVertices& vertices, uint32_t n)
      : vertices_(vertices), n_(n), grid_((std::size_t{n} + 1) * (n + 1)) {}

  // Row i of the grid is i steps away from vertex 0, its column k k steps from the side 01. Adds
  // the pieces to `pieces`; false if keep_going stopped it.
  bool divide(const Piece& patch, std::vector<Piece>& pieces, const KeepGoing& keep_going) {
    patch_ = &patch;
    for (std::size_t k = 0; n_ > 1 && k < 3; ++k) {
      sides_[k] =
          vertices_.between(patch.patch, patch.corner[k], patch.corner[(k + 1) % 3], n_ - 1);
    }
    for (uint32_t i = 0; i <= n_; ++i) {
      if (!may_go_on(keep_going)) return false;
      for (uint32_t k = 0; k <= i; ++k) at(i, k) = vertex(i, k);
    }
    const auto add = [&](glm::uvec2 a, glm::uvec2 b, glm::uvec2 c) {
      pieces.push_back({patch.patch, {corner(a), corner(b), corner(c)}});
    };
    for (uint32_t i = 0; i < n_; ++i) {
      for (uint32_t k = 0; k <= i; ++k) {
        add({i, k}, {i + 1, k}, {i + 1, k + 1});
        if (k < i) add({i, k}, {i + 1, k + 1}, {i, k + 1});
      }
    }
    return true;
  }

 private:
  uint32_t& at(uint32_t i, uint32_t k) { return grid_[std::size_t{i} * (n_ + 1) + k]; }

  [[nodiscard]] dvec3 weights(uint32_t i, uint32_t k) const {
    return dvec3(n_ - i, i - k, k) / static_cast<double>(n_);
  }

  PieceCorner corner(glm::uvec2 step) { return {at(step.x, step.y), weights(step.x, step.y)}; }

  // The step-th of n along a side.
  [[nodiscard]] uint32_t along(std::size_t side, uint32_t step) const {
    const SurfaceVertices::Between& between = sides_[side];
    return between.first + (between.reversed ? n_ - step : step) - 1;
  }

  uint32_t vertex(uint32_t i, uint32_t k) {
    if (i == 0) return patch_->corner[0].vertex;
    if (i == n_ && k == 0) return patch_->corner[1].vertex;
    if (i == n_ && k == n_) return patch_->corner[2].vertex;
    if (k == 0) return along(0, i);
    if (i == n_) return along(1, k);
    if (k == i) return along(2, n_ - i);
    return vertices_.within(patch_->patch, weights(i, k));
  }

  SurfaceVertices& vertices_;
  uint32_t n_;
  std::vector<uint32_t> grid_;  // vertices
  const Piece* patch_ = nullptr;
  std::array<SurfaceVertices::Between, 3> sides_{};
};

}  // namespace

std::optional<FlatMesh> divided_evenly(const Mesh& mesh, const BakedScene& scene, uint32_t n,
                                       const FractionProgress& progress) {
  const std::size_t patches = scene.triangles.size();
  if (patches * n * n > kMostFlatTriangles) too_many();
  SurfaceVertices vertices(mesh, scene);
  EvenDivision division(vertices, n);
  std::vector<Piece> pieces;
  pieces.reserve(patches * n * n);
  constexpr double divided = 0.5;  // of the work
  const KeepGoing keep_going = [&] {
    return may_go_on(progress, divided * static_cast<double>(pieces.size()) /
                                   static_cast<double>(pieces.capacity()));
  };
  for (const Piece& patch : whole_patches(patches, vertices)) {
    if (!division.divide(patch, pieces, keep_going)) return std::nullopt;
  }
  const PieceBounds bounds(scene, vertices);
  const auto measure = [&](Piece& piece) { bounds.measure(piece); };
  if (!for_pieces(pieces, measure, part_of(progress, divided, 1.0))) return std::nullopt;
  return mesh_of(pieces, vertices, kInfinity);
}

std::optional<FlatMesh> divided_to(const Mesh& mesh, const BakedScene& scene, double error,
                                   const FractionProgress& progress) {
  Refinement refinement(mesh, scene, error);
  for (;;) {
    switch (refinement.refine(progress)) {
      case Refinement::Round::divided:
        break;
      case Refinement::Round::nothing_left:
        return refinement.mesh();
      case Refinement::Round::stopped:
        return std::nullopt;
    }
  }
}

std::vector<uint32_t> first_at_same_place(const FlatMesh& mesh) {
  std::vector<uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto before = [&](uint32_t a, uint32_t b) {
    const dvec3& p = mesh.positions[a];
    const dvec3& q = mesh.positions[b];
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
  };
  std::stable_sort(order.begin(), order.end(), before);
  std::vector<uint32_t> first(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && !before(order[k - 1], order[k]);
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  return first;
}

std::size_t count_open_edges(const FlatMesh& mesh) {
  const std::vector<uint32_t> first = first_at_same_place(mesh);
  const std::vector<Side> sides = sides_of(mesh.triangles.size(), [&](uint32_t t) {
    const glm::uvec3& corners = mesh.triangles[t];
    return std::array<uint32_t, 3>{first[corners.x], first[corners.y], first[corners.z]};
  });
  std::size_t open = 0;
  for_edges(sides, [&](std::span<const Side> edge) { open += edge.size() == 1 ? 1 : 0; });
  return open;
}

}  // namespace trisect
