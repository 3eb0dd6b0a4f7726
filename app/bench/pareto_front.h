// The Pareto front of time and error.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace trisect::bench {

struct Point {
  double error;
  double ms;
};

// For each point the index of a point that dominates it, that is, one that is no worse in error and
// in time and better in one of them; the fastest if there are several. Nothing for the points of
// the Pareto front. A NaN counts as infinite.
std::vector<std::optional<std::size_t>> dominating(const std::vector<Point>& points);

}  // namespace trisect::bench
