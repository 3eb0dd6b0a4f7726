// Which of several ways are worth taking.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace trisect::bench {

struct Point {
  double error;
  double ms;
};

// For each point another one that is no worse in either and better in one of the two, the fastest
// of them; nothing for the points of the Pareto front. A NaN is dominated by every number.
std::vector<std::optional<std::size_t>> dominating(const std::vector<Point>& points);

}  // namespace trisect::bench
