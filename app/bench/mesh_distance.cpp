#include "app/bench/mesh_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "app/base/interval.h"
#include "app/base/parallel_rows.h"

namespace trisect::bench {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::uvec3;

struct DirectedEdge {
  uint32_t from;
  uint32_t to;
  uint32_t triangle;
  glm::length_t k;

  [[nodiscard]] std::pair<uint32_t, uint32_t> ends() const { return {from, to}; }
};

std::vector<uvec3> neighbours_of(const FlatMesh& mesh) {
  const std::vector<uint32_t> place = first_at_same_place(mesh);
  std::vector<DirectedEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const uvec3& corners = mesh.triangles[t];
    for (glm::length_t k = 0; k < 3; ++k) {
      edges.push_back({place[corners[k]], place[corners[(k + 1) % 3]], t, k});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const auto& a, const auto& b) { return a.ends() < b.ends(); });
  const auto ends_before = [](const DirectedEdge& edge, const std::pair<uint32_t, uint32_t>& ends) {
    return edge.ends() < ends;
  };
  std::vector<uvec3> across(mesh.triangles.size(), uvec3(Target::kNone));
  for (const DirectedEdge& edge : edges) {
    const std::pair<uint32_t, uint32_t> reversed{edge.to, edge.from};
    const auto other = std::lower_bound(edges.begin(), edges.end(), reversed, ends_before);
    if (other != edges.end() && other->ends() == reversed) {
      across[edge.triangle][edge.k] = other->triangle;
    }
  }
  return across;
}

using Corners = std::array<dvec3, 3>;

Corners corners_of(const FlatMesh& mesh, uint32_t triangle) {
  const uvec3& at = mesh.triangles[triangle];
  return {mesh.positions[at.x], mesh.positions[at.y], mesh.positions[at.z]};
}

// A piece of a triangle of the surface that is measured.
struct Piece {
  Corners corners;
  std::array<NearPoint, 3> near;
};

// The first bound of largest_distance().
double bound_by_one(const Piece& piece, const Target& to) {
  double least = kInfinity;
  for (std::size_t k = 0; k < 3; ++k) {
    double largest = piece.near[k].distance;
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == k) continue;
      largest = std::max(
          largest,
          nearest_of_triangle(to.mesh(), piece.near[k].triangle, piece.corners[i]).distance);
    }
    least = std::min(least, largest);
  }
  return least;
}

// The second one, for one piece after the other.
class Covering {
 public:
  explicit Covering(const Target& to) : to_(to), met_(to.mesh().triangles.size(), 0) {}

  // Infinite if the target is not proven to cover the piece.
  double bound(const Piece& piece) {
    if (!look_along_normal(piece.corners)) return kInfinity;
    const NearPoint middle =
        to_.nearest((piece.corners[0] + piece.corners[1] + piece.corners[2]) / 3.0);
    if (++now_ == 0) {
      std::fill(met_.begin(), met_.end(), 0);
      now_ = 1;
    }
    next_.clear();
    meet(middle.triangle);
    double largest = 0.0;
    for (std::size_t i = 0; i < next_.size(); ++i) {
      if (i == kMost) return kInfinity;
      const uint32_t triangle = next_[i];
      const Corners seen = seen_corners(triangle);
      if (!faces_along(seen)) return kInfinity;
      const std::vector<dvec3>& over = clipped({seen.begin(), seen.end()});
      // The first one must overlap the piece, the others may only touch it.
      if (over.empty()) {
        if (i == 0) return kInfinity;
        continue;
      }
      for (const dvec3& point : over) largest = std::max(largest, std::abs(point.z));
      for (glm::length_t k = 0; k < 3; ++k) {
        if (clipped(
                {seen[static_cast<std::size_t>(k)], seen[static_cast<std::size_t>((k + 1) % 3)]})
                .empty()) {
          continue;
        }
        const uint32_t neighbour = to_.across(triangle, k);
        if (neighbour == Target::kNone) return kInfinity;
        meet(neighbour);
      }
    }
    return largest + kMargin * size_;
  }

 private:
  static constexpr double kMargin = 1e-9;

  // A piece over which there are more triangles is divided first.
  static constexpr std::size_t kMost = 20000;

  // Axes with z along the piece's normal and its first corner at the origin. False if it has no
  // area.
  bool look_along_normal(const Corners& corners) {
    origin_ = corners[0];
    const dvec3 e = corners[1] - corners[0];
    const dvec3 f = corners[2] - corners[0];
    const dvec3 normal = glm::cross(e, f);
    size_ = std::max(glm::length(e), glm::length(f));
    if (!(glm::length(normal) > 1e-9 * size_ * size_)) return false;
    z_ = glm::normalize(normal);
    x_ = glm::normalize(e);
    y_ = glm::cross(z_, x_);
    // A little smaller, so that what ends where the piece does ends beyond it; what is left out is
    // no farther from it than kMargin of the size.
    const dvec2 middle = dvec2(seen((corners[0] + corners[1] + corners[2]) / 3.0));
    for (std::size_t k = 0; k < 3; ++k) {
      outline_[k] = middle + (1.0 - kMargin) * (dvec2(seen(corners[k])) - middle);
    }
    return true;
  }

  [[nodiscard]] dvec3 seen(const dvec3& point) const {
    const dvec3 d = point - origin_;
    return {glm::dot(d, x_), glm::dot(d, y_), glm::dot(d, z_)};
  }

  [[nodiscard]] Corners seen_corners(uint32_t triangle) const {
    const Corners corners = corners_of(to_.mesh(), triangle);
    return {seen(corners[0]), seen(corners[1]), seen(corners[2])};
  }

  static bool faces_along(const Corners& seen) {
    const dvec3 e = seen[1] - seen[0];
    const dvec3 f = seen[2] - seen[0];
    return e.x * f.y - e.y * f.x > 1e-9 * std::max(glm::dot(e, e), glm::dot(f, f));
  }

  // What of a polygon, or of a line, is over the piece.
  const std::vector<dvec3>& clipped(std::vector<dvec3> points) {
    polygon_ = std::move(points);
    for (std::size_t k = 0; k < 3 && !polygon_.empty(); ++k) {
      const dvec2 start = outline_[k];
      const dvec2 edge = glm::normalize(outline_[(k + 1) % 3] - start);
      const auto inside = [&](const dvec3& p) {
        return edge.x * (p.y - start.y) - edge.y * (p.x - start.x);
      };
      rest_.clear();
      for (std::size_t i = 0; i < polygon_.size(); ++i) {
        const dvec3& a = polygon_[i];
        const dvec3& b = polygon_[(i + 1) % polygon_.size()];
        const double at_a = inside(a);
        const double at_b = inside(b);
        if (at_a >= 0.0) rest_.push_back(a);
        if ((at_a < 0.0) != (at_b < 0.0)) rest_.push_back(a + (at_a / (at_a - at_b)) * (b - a));
      }
      std::swap(polygon_, rest_);
    }
    return polygon_;
  }

  void meet(uint32_t triangle) {
    if (met_[triangle] == now_) return;
    met_[triangle] = now_;
    next_.push_back(triangle);
  }

  const Target& to_;
  std::vector<uint32_t> met_;  // by triangle: the piece over which it was met last
  uint32_t now_ = 0;
  std::vector<uint32_t> next_;  // those that were met over this piece
  dvec3 origin_{0.0};
  dvec3 x_{0.0};
  dvec3 y_{0.0};
  dvec3 z_{0.0};
  double size_ = 0.0;
  std::array<dvec2, 3> outline_{};
  std::vector<dvec3> polygon_;
  std::vector<dvec3> rest_;
};

// A piece's four quarters: three at its corners, one in its middle.
std::array<Piece, 4> quarters_of(const Piece& piece, const Target& to) {
  Piece middles;
  for (std::size_t k = 0; k < 3; ++k) {
    middles.corners[k] = 0.5 * (piece.corners[(k + 1) % 3] + piece.corners[(k + 2) % 3]);
    middles.near[k] = to.nearest(middles.corners[k]);
  }
  std::array<Piece, 4> quarters{middles, middles, middles, middles};
  for (std::size_t k = 0; k < 3; ++k) {
    // A corner with the middles of its two edges, in the winding of the piece.
    const std::size_t next = (k + 1) % 3;
    const std::size_t last = (k + 2) % 3;
    Piece& quarter = quarters[k];
    quarter.corners = {piece.corners[k], middles.corners[last], middles.corners[next]};
    quarter.near = {piece.near[k], middles.near[last], middles.near[next]};
  }
  return quarters;
}

double largest_at_corners(const Piece& piece) {
  return std::max({piece.near[0].distance, piece.near[1].distance, piece.near[2].distance});
}

// As many chunks for each core that their work evens out.
std::size_t chunk_size(std::size_t count) {
  return std::max<std::size_t>(count / 64, 64);
}

constexpr std::size_t kMostPieces = 2'000'000;
constexpr int kMostGenerations = 16;

}  // namespace

Target::Target(const FlatMesh& mesh) : nearest_(mesh), across_(neighbours_of(mesh)) {}

std::optional<LargestDistance> largest_distance(const FlatMesh& from, const Target& to,
                                                double resolution,
                                                const FractionProgress& progress) {
  // Half of the progress is the first look at every vertex and triangle.
  const auto told = [&](double first, double part, std::size_t of) -> Progress {
    return [&progress, first, part, of](uint32_t done) {
      return may_go_on(progress, first + part * done / static_cast<double>(of));
    };
  };
  std::vector<NearPoint> near(from.positions.size());
  if (!parallel_chunks(
          near.size(), kChunk,
          [&](std::size_t first, std::size_t end) {
            for (std::size_t i = first; i < end; ++i) near[i] = to.nearest(from.positions[i]);
          },
          told(0.0, 0.25, near.size()))) {
    return std::nullopt;
  }
  std::vector<Piece> pieces(from.triangles.size());
  LargestDistance largest;
  for (std::size_t t = 0; t < pieces.size(); ++t) {
    const uvec3& at = from.triangles[t];
    pieces[t] = {corners_of(from, static_cast<uint32_t>(t)), {near[at.x], near[at.y], near[at.z]}};
    largest.found = std::max(largest.found, largest_at_corners(pieces[t]));
  }
  double settled = 0.0;  // the largest bound of pieces that need not be looked at further
  for (int generation = 0; !pieces.empty(); ++generation) {
    const double enough = 1.01 * largest.found + resolution;
    std::vector<double> bounds(pieces.size());
    const auto bound = [&](std::size_t first, std::size_t end) {
      Covering covering(to);
      for (std::size_t i = first; i < end; ++i) {
        bounds[i] = bound_by_one(pieces[i], to);
        if (bounds[i] > largest.found) bounds[i] = std::min(bounds[i], covering.bound(pieces[i]));
      }
    };
    if (!parallel_chunks(pieces.size(), chunk_size(pieces.size()), bound,
                         told(generation == 0 ? 0.25 : 0.5, 0.25, pieces.size()))) {
      return std::nullopt;
    }
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (bounds[i] > enough) {
        left.push_back(i);
      } else {
        settled = std::max(settled, bounds[i]);
      }
    }
    if (generation == kMostGenerations || 4 * left.size() > kMostPieces) {
      for (const std::size_t i : left) settled = std::max(settled, bounds[i]);
      break;
    }
    std::vector<Piece> next(4 * left.size());
    const auto divide = [&](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) {
        const std::array<Piece, 4> quarters = quarters_of(pieces[left[i]], to);
        std::copy(quarters.begin(), quarters.end(),
                  next.begin() + static_cast<std::ptrdiff_t>(4 * i));
      }
    };
    if (!parallel_chunks(left.size(), kChunk, divide, told(0.5, 0.5, left.size()))) {
      return std::nullopt;
    }
    pieces = std::move(next);
    for (const Piece& piece : pieces) {
      largest.found = std::max(largest.found, largest_at_corners(piece));
    }
  }
  largest.bound = std::max(settled, largest.found);
  return largest;
}

std::optional<Samples> sampled(const FlatMesh& from, const Target& to, std::size_t count,
                               const FractionProgress& progress) {
  // The area of a triangle and all before it.
  std::vector<double> areas;
  double area = 0.0;
  for (uint32_t t = 0; t < from.triangles.size(); ++t) {
    const Corners p = corners_of(from, t);
    area += glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    areas.push_back(area);
  }
  struct Sample {
    uint32_t triangle = 0;
    dvec3 weights{0.0};
    double distance = 0.0;
    double shading_degrees = 0.0;
    double face_degrees = 0.0;
  };
  std::vector<Sample> samples(count);
  std::mt19937_64 random(1);
  const auto number = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
  for (Sample& sample : samples) {
    const auto at = std::upper_bound(areas.begin(), areas.end() - 1, number() * area);
    sample.triangle = static_cast<uint32_t>(at - areas.begin());
    const double root = std::sqrt(number());
    const double part = number();
    sample.weights = {1.0 - root, root * (1.0 - part), root * part};
  }
  const auto normal_at = [](const FlatMesh& mesh, uint32_t triangle, const dvec3& weights) {
    const uvec3& at = mesh.triangles[triangle];
    return dvec3(mesh.normals[at.x]) * weights.x + dvec3(mesh.normals[at.y]) * weights.y +
           dvec3(mesh.normals[at.z]) * weights.z;
  };
  const auto look = [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      Sample& sample = samples[i];
      const Corners p = corners_of(from, sample.triangle);
      const NearPoint near =
          to.nearest(p[0] * sample.weights.x + p[1] * sample.weights.y + p[2] * sample.weights.z);
      const dvec3 normal = normal_at(to.mesh(), near.triangle, near.weights);
      sample.distance = near.distance;
      sample.shading_degrees =
          degrees_between(normal_at(from, sample.triangle, sample.weights), normal);
      sample.face_degrees = degrees_between(glm::cross(p[1] - p[0], p[2] - p[0]), normal);
    }
  };
  if (!parallel_chunks(count, kChunk, look, [&](uint32_t done) {
        return may_go_on(progress, done / static_cast<double>(count));
      })) {
    return std::nullopt;
  }
  const auto quantiles = [&](double Sample::*member) {
    std::vector<double> values;
    values.reserve(count);
    for (const Sample& sample : samples) values.push_back(sample.*member);
    return quantiles_of(std::move(values));
  };
  double squares = 0.0;
  for (const Sample& sample : samples) squares += sample.distance * sample.distance;
  return Samples{quantiles(&Sample::distance), std::sqrt(squares / static_cast<double>(count)),
                 quantiles(&Sample::shading_degrees), quantiles(&Sample::face_degrees)};
}

}  // namespace trisect::bench
