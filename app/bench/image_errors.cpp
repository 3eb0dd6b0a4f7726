#include "app/bench/image_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "app/base/srgb.h"

namespace trisect::bench {
namespace {

constexpr std::size_t kReach = 5;

// By the distance from the window's middle.
using Weights = std::array<double, kReach + 1>;

Weights gaussian() {
  Weights weights{};
  for (std::size_t k = 0; k <= kReach; ++k) {
    const double apart = static_cast<double>(k) / 1.5;
    weights[k] = std::exp(-0.5 * apart * apart);
  }
  return weights;
}

// One number for each pixel.
struct Plane {
  std::size_t width;
  std::size_t height;
  std::vector<double> values;
};

// The weighted means in the windows about each of `count` numbers that are `step` apart.
void smooth(const double* from, double* to, std::size_t count, std::size_t step,
            const Weights& weights) {
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0.0;
    double weight = 0.0;
    const std::size_t end = std::min(i + kReach + 1, count);
    for (std::size_t k = i - std::min(i, kReach); k < end; ++k) {
      const double w = weights[k < i ? i - k : k - i];
      sum += w * from[k * step];
      weight += w;
    }
    to[i * step] = sum / weight;
  }
}

Plane means(const Plane& plane) {
  static const Weights weights = gaussian();
  Plane across = plane;
  for (std::size_t y = 0; y < plane.height; ++y) {
    const std::size_t row = y * plane.width;
    smooth(&plane.values[row], &across.values[row], plane.width, 1, weights);
  }
  Plane both = plane;
  for (std::size_t x = 0; x < plane.width; ++x) {
    smooth(&across.values[x], &both.values[x], plane.height, plane.width, weights);
  }
  return both;
}

Plane luma_of(const Frame& frame) {
  Plane plane{frame.width, frame.height, {}};
  plane.values.reserve(frame.colors.size());
  for (const vec4& color : frame.colors) {
    plane.values.push_back(glm::dot(glm::dvec3(color), glm::dvec3(0.2126, 0.7152, 0.0722)));
  }
  return plane;
}

Plane product(const Plane& a, const Plane& b) {
  Plane result{a.width, a.height, a.values};
  for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] *= b.values[i];
  return result;
}

}  // namespace

double structural_similarity(const Frame& a, const Frame& b) {
  constexpr double c1 = 0.01 * 0.01;
  constexpr double c2 = 0.03 * 0.03;
  const Plane x = luma_of(a);
  const Plane y = luma_of(b);
  const Plane mean_x = means(x);
  const Plane mean_y = means(y);
  const Plane mean_xx = means(product(x, x));
  const Plane mean_yy = means(product(y, y));
  const Plane mean_xy = means(product(x, y));
  double sum = 0.0;
  for (std::size_t i = 0; i < x.values.size(); ++i) {
    const double mx = mean_x.values[i];
    const double my = mean_y.values[i];
    const double xx = mean_xx.values[i] - mx * mx;
    const double yy = mean_yy.values[i] - my * my;
    const double xy = mean_xy.values[i] - mx * my;
    sum += (2.0 * mx * my + c1) * (2.0 * xy + c2) / ((mx * mx + my * my + c1) * (xx + yy + c2));
  }
  return sum / static_cast<double>(x.values.size());
}

double relative_square_error(const Frame& frame, const Frame& truth) {
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.colors.size(); ++i) {
    for (glm::length_t k = 0; k < 3; ++k) {
      const double t = linear_from_srgb(truth.colors[i][k]);
      const double apart = linear_from_srgb(frame.colors[i][k]) - t;
      sum += apart * apart / (t * t + 0.01);
    }
  }
  return sum / (3.0 * static_cast<double>(truth.colors.size()));
}

}  // namespace trisect::bench
