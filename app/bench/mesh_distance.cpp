#include "app/bench/mesh_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <mutex>
#include <random>
#include <span>
#include <utility>

#include "app/base/interval.h"
#include "app/base/parallel_rows.h"
#include "app/mesh/edges.h"

namespace trisect::bench {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::uvec3;

std::vector<uvec3> neighbours_of(const FlatMesh& mesh) {
  const std::vector<uint32_t> place = first_at_same_place(mesh);
  const std::vector<Side> sides = sides_of(mesh.triangles.size(), [&](uint32_t t) {
    const uvec3& at = mesh.triangles[t];
    return std::array{place[at.x], place[at.y], place[at.z]};
  });
  std::vector<uvec3> across(mesh.triangles.size(), uvec3(Target::kNone));
  for_edges(sides, [&](std::span<const Side> edge) {
    for (const Side& side : edge) {
      const auto other = std::find_if(edge.begin(), edge.end(), [&](const Side& candidate) {
        return candidate.forward != side.forward;
      });
      if (other != edge.end()) across[side.triangle][side.corner] = other->triangle;
    }
  });
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
    ++now_;
    next_.clear();
    meet(middle.triangle);
    const int way = way_of(seen_corners(middle.triangle));
    double largest = 0.0;
    for (std::size_t i = 0; i < next_.size(); ++i) {
      if (i == kMost) return kInfinity;
      const uint32_t triangle = next_[i];
      const Corners seen = seen_corners(triangle);
      if (way == 0 || way_of(seen) != way) return kInfinity;
      const std::vector<dvec3>& over = clipped(seen);
      // The first one must overlap the piece, the others may only touch it.
      if (over.empty()) {
        if (i == 0) return kInfinity;
        continue;
      }
      for (const dvec3& point : over) largest = std::max(largest, std::abs(point.z));
      for (std::size_t k = 0; k < 3; ++k) {
        if (clipped(std::array{seen[k], seen[(k + 1) % 3]}).empty()) continue;
        const uint32_t neighbour = to_.across(triangle, static_cast<glm::length_t>(k));
        if (neighbour == Target::kNone) return kInfinity;
        meet(neighbour);
      }
    }
    return largest + kMargin * size_ + unevenness_;
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
    unevenness_ = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const dvec3 corner = seen(corners[k]);
      unevenness_ = std::max(unevenness_, std::abs(corner.z));
      outline_[k] = middle + (1.0 - kMargin) * (dvec2(corner) - middle);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      edges_[k] = glm::normalize(outline_[(k + 1) % 3] - outline_[k]);
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

  // 1 if a triangle faces the way of the piece's normal, -1 if it faces the other way, 0 if it is
  // seen from its edge.
  static int way_of(const Corners& seen) {
    const dvec3 e = seen[1] - seen[0];
    const dvec3 f = seen[2] - seen[0];
    const double area = e.x * f.y - e.y * f.x;
    if (std::abs(area) <= 1e-9 * std::max(glm::dot(e, e), glm::dot(f, f))) return 0;
    return area > 0.0 ? 1 : -1;
  }

  // What of a polygon, or of a line, is over the piece.
  const std::vector<dvec3>& clipped(std::span<const dvec3> points) {
    polygon_.assign(points.begin(), points.end());
    for (std::size_t k = 0; k < 3 && !polygon_.empty(); ++k) {
      const auto inside = [&](const dvec3& p) {
        return edges_[k].x * (p.y - outline_[k].y) - edges_[k].y * (p.x - outline_[k].x);
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
  double unevenness_ = 0.0;  // how far the piece's corners are off its plane, by roundings
  std::array<dvec2, 3> outline_{};
  std::array<dvec2, 3> edges_{};  // their directions
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

// Coverings of a target, for whichever threads ask.
class Coverings {
 public:
  explicit Coverings(const Target& to) : to_(to) {}

  // Calls use(covering), with one that nobody else uses.
  template <typename Use>
  void with_one(Use&& use) {
    std::unique_ptr<Covering> covering;
    {
      const std::scoped_lock lock(mutex_);
      if (!free_.empty()) {
        covering = std::move(free_.back());
        free_.pop_back();
      }
    }
    if (!covering) covering = std::make_unique<Covering>(to_);
    use(*covering);
    const std::scoped_lock lock(mutex_);
    free_.push_back(std::move(covering));
  }

 private:
  const Target& to_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Covering>> free_;
};

// A piece may take milliseconds, and a few of them have to keep all cores busy.
std::size_t chunk_of_pieces(std::size_t count) {
  return std::clamp<std::size_t>(count / 256, 1, 64);
}

struct BoundedPiece {
  Piece piece;
  double bound;
};

constexpr std::size_t kMostDivided = 500'000;
constexpr int kMostDivisions = 16;

class LargestDistanceSearch {
 public:
  LargestDistanceSearch(const FlatMesh& from, const Target& to, double resolution,
                        const FractionProgress& progress)
      : from_(from), to_(to), resolution_(resolution), progress_(progress), coverings_(to) {}

  std::optional<LargestDistance> run() {
    if (!look_at_triangles()) return std::nullopt;
    // Each division has half of what is left of the progress.
    for (int division = 0; division < kMostDivisions && !open_.empty(); ++division) {
      if (!divide(1.0 - std::exp2(-1 - division), std::exp2(-2 - division))) return std::nullopt;
    }
    for (const BoundedPiece& one : open_) settled_ = std::max(settled_, one.bound);
    return LargestDistance{found_, std::max(settled_, found_)};
  }

 private:
  [[nodiscard]] Progress told(double first, double part, std::size_t of) const {
    return [this, first, part, of](uint32_t done) {
      return may_go_on(progress_, first + part * done / static_cast<double>(of));
    };
  }

  bool look_at_triangles() {
    std::vector<NearPoint> near(from_.positions.size());
    const auto look = [&](std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) near[i] = to_.nearest(from_.positions[i]);
    };
    if (!parallel_chunks(near.size(), kChunk, look, told(0.0, 0.25, near.size()))) return false;
    const auto piece_of = [&](std::size_t t) {
      const uvec3& at = from_.triangles[t];
      return Piece{corners_of(from_, static_cast<uint32_t>(t)),
                   {near[at.x], near[at.y], near[at.z]}};
    };
    for (const uvec3& at : from_.triangles) {
      found_ = std::max({found_, near[at.x].distance, near[at.y].distance, near[at.z].distance});
    }
    return bound(from_.triangles.size(), piece_of, told(0.25, 0.25, from_.triangles.size()));
  }

  // Divides the open pieces, those with the largest bounds if there are too many.
  bool divide(double first, double part) {
    if (open_.size() > kMostDivided) {
      const auto end = open_.begin() + static_cast<std::ptrdiff_t>(kMostDivided);
      std::nth_element(open_.begin(), end, open_.end(),
                       [](const auto& a, const auto& b) { return a.bound > b.bound; });
      settled_ = std::max(settled_, end->bound);
      open_.erase(end, open_.end());
    }
    std::vector<Piece> pieces(4 * open_.size());
    const auto quarter = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::array<Piece, 4> quarters = quarters_of(open_[i].piece, to_);
        std::copy(quarters.begin(), quarters.end(),
                  pieces.begin() + static_cast<std::ptrdiff_t>(4 * i));
      }
    };
    if (!parallel_chunks(open_.size(), kChunk, quarter, told(first, 0.5 * part, open_.size()))) {
      return false;
    }
    for (const Piece& piece : pieces) {
      for (const NearPoint& near : piece.near) found_ = std::max(found_, near.distance);
    }
    return bound(
        pieces.size(), [&](std::size_t i) { return pieces[i]; },
        told(first + 0.5 * part, 0.5 * part, pieces.size()));
  }

  // Bounds pieces, and leaves those open whose bound is too large.
  bool bound(std::size_t count, const std::function<Piece(std::size_t)>& piece_of,
             const Progress& progress) {
    std::vector<double> bounds(count);
    const auto bound_some = [&](std::size_t first, std::size_t end) {
      coverings_.with_one([&](Covering& covering) {
        for (std::size_t i = first; i < end; ++i) {
          const Piece piece = piece_of(i);
          bounds[i] = bound_by_one(piece, to_);
          if (bounds[i] > found_) bounds[i] = std::min(bounds[i], covering.bound(piece));
        }
      });
    };
    if (!parallel_chunks(count, chunk_of_pieces(count), bound_some, progress)) return false;
    open_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      if (bounds[i] > 1.01 * found_ + resolution_) {
        open_.push_back({piece_of(i), bounds[i]});
      } else {
        settled_ = std::max(settled_, bounds[i]);
      }
    }
    return true;
  }

  const FlatMesh& from_;
  const Target& to_;
  double resolution_;
  const FractionProgress& progress_;
  Coverings coverings_;
  double found_ = 0.0;
  double settled_ = 0.0;  // the largest bound of pieces that are not looked at any more
  std::vector<BoundedPiece> open_;
};

}  // namespace

Target::Target(const FlatMesh& mesh) : nearest_(mesh), across_(neighbours_of(mesh)) {}

std::optional<LargestDistance> largest_distance(const FlatMesh& from, const Target& to,
                                                double resolution,
                                                const FractionProgress& progress) {
  return LargestDistanceSearch(from, to, resolution, progress).run();
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
