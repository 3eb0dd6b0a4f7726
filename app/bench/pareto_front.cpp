#include "app/bench/pareto_front.h"

#include <cmath>
#include <limits>

namespace trisect::bench {

std::vector<std::optional<std::size_t>> dominating(const std::vector<Point>& points) {
  const auto number = [](double a) {
    return std::isnan(a) ? std::numeric_limits<double>::infinity() : a;
  };
  std::vector<std::optional<std::size_t>> by(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double error = number(points[i].error);
    const double ms = number(points[i].ms);
    for (std::size_t j = 0; j < points.size(); ++j) {
      const double other_error = number(points[j].error);
      const double other_ms = number(points[j].ms);
      const bool no_worse = other_error <= error && other_ms <= ms;
      const bool better = other_error < error || other_ms < ms;
      if (!no_worse || !better) continue;
      if (!by[i] || other_ms < number(points[*by[i]].ms)) by[i] = j;
    }
  }
  return by;
}

}  // namespace trisect::bench
