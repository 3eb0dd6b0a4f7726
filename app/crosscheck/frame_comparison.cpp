#include "app/crosscheck/frame_comparison.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>

#include "app/base/error.h"
#include "app/base/max_propagating_nan.h"
#include "app/base/ulp.h"

namespace trisect {
namespace {

bool is_hit(const Frame& frame, std::size_t pixel) {
  return frame.aovs.empty() ? frame.colors[pixel].w > 0.0F
                            : frame.aovs[pixel].triangle != NO_TRIANGLE;
}

bool same_bits(float a, float b) {
  return std::bit_cast<uint32_t>(a) == std::bit_cast<uint32_t>(b);
}

FrameComparison::Depth compare_depth(const Frame& a, const Frame& b) {
  FrameComparison::Depth depth;
  std::vector<double> ulp;
  std::vector<double> degrees;
  for (std::size_t i = 0; i < a.aovs.size(); ++i) {
    const PixelAovs& p = a.aovs[i];
    const PixelAovs& q = b.aovs[i];
    if (p.triangle == NO_TRIANGLE || q.triangle == NO_TRIANGLE) continue;
    if (p.triangle != q.triangle) {
      ++depth.patch_mismatches;
      continue;
    }
    ++depth.pixels;
    const float za = p.normal_z.w;
    const float zb = q.normal_z.w;
    if (same_bits(za, zb)) ++depth.bit_equal;
    ulp.push_back(std::abs(static_cast<double>(za) - static_cast<double>(zb)) / ulp_of(za));
    degrees.push_back(degrees_between(glm::dvec3(p.geometric_u), glm::dvec3(q.geometric_u)));
  }
  depth.ulp = quantiles_of(std::move(ulp));
  depth.normal_degrees = quantiles_of(std::move(degrees));
  return depth;
}

// A share of nothing is 0.
double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

void expect_same_size(const Frame& a, const Frame& b) {
  if (a.width == b.width && a.height == b.height) return;
  throw InputError(fmt::format("images of {}x{} and {}x{} pixels cannot be compared.", a.width,
                               a.height, b.width, b.height));
}

// As FrameComparison has it.
struct ColorDifference {
  double rmse = 0.0;
  double largest = 0.0;         // NaN if any is
  double largest_number = 0.0;  // of those that are not NaN
};

ColorDifference color_difference(const Frame& a, const Frame& b) {
  ColorDifference difference;
  double squares = 0.0;
  for (std::size_t i = 0; i < a.colors.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const double steps =
          255.0 * (static_cast<double>(a.colors[i][k]) - static_cast<double>(b.colors[i][k]));
      squares += steps * steps;
      max_propagating_nan(difference.largest, std::abs(steps));
      if (std::abs(steps) > difference.largest_number) difference.largest_number = std::abs(steps);
    }
  }
  difference.rmse = std::sqrt(squares / (3.0 * static_cast<double>(a.colors.size())));
  return difference;
}

vec4 mask_color(const Frame& a, const Frame& b, std::size_t pixel) {
  const bool hit_a = is_hit(a, pixel);
  const bool hit_b = is_hit(b, pixel);
  if (hit_a != hit_b) return {1.0F, 0.0F, 0.0F, 1.0F};
  if (!hit_a) return {0.0F, 0.0F, 0.0F, 1.0F};
  if (!a.aovs.empty() && !b.aovs.empty()) {
    const PixelAovs& p = a.aovs[pixel];
    const PixelAovs& q = b.aovs[pixel];
    if (p.triangle != q.triangle) return {1.0F, 1.0F, 0.0F, 1.0F};
    if (!same_bits(p.normal_z.w, q.normal_z.w)) return {0.3F, 0.5F, 1.0F, 1.0F};
  }
  return {0.35F, 0.35F, 0.35F, 1.0F};
}

}  // namespace

FrameComparison compare(const Frame& a, const Frame& b) {
  expect_same_size(a, b);
  FrameComparison result;
  result.pixels = a.colors.size();
  for (std::size_t i = 0; i < a.colors.size(); ++i) {
    const bool hit_a = is_hit(a, i);
    const bool hit_b = is_hit(b, i);
    if (hit_a || hit_b) ++result.hits;
    if (hit_a != hit_b) ++result.hit_mismatches;
  }
  const ColorDifference color = color_difference(a, b);
  result.color_rmse = color.rmse;
  result.color_max = color.largest;
  result.psnr = 20.0 * std::log10(255.0 / result.color_rmse);
  if (!a.aovs.empty() && !b.aovs.empty()) result.depth = compare_depth(a, b);
  return result;
}

std::vector<std::string> excesses(const FrameComparison& comparison, const Tolerance& tolerance) {
  std::vector<std::string> found;
  // Written this way round, a NaN exceeds every limit.
  const auto limit = [&](const char* what, double value, double most) {
    if (!(value <= most)) found.push_back(fmt::format("{} {:.6g} > {:.6g}", what, value, most));
  };
  limit("hit mismatches, of the pixels", share(comparison.hit_mismatches, comparison.pixels),
        tolerance.hit_mismatches);
  if (comparison.depth) {
    const FrameComparison::Depth& depth = *comparison.depth;
    limit("patch mismatches, of the pixels", share(depth.patch_mismatches, comparison.pixels),
          tolerance.patch_mismatches);
    limit("Z of other bits, of the hits", share(depth.pixels - depth.bit_equal, depth.pixels),
          tolerance.z_differs);
  }
  limit("colour RMSE, 8-bit steps", comparison.color_rmse, tolerance.color_rmse);
  limit("largest colour difference, 8-bit steps", comparison.color_max, tolerance.color_max);
  return found;
}

std::string to_text(const FrameComparison& c) {
  std::string text =
      fmt::format("  {} pixels, {} hit, {} hit mismatches", c.pixels, c.hits, c.hit_mismatches);
  if (c.depth) {
    const FrameComparison::Depth& d = *c.depth;
    text += fmt::format(
        ", {} patch mismatches\n  Z of the same bits in {} of {}, apart by {:.3g} ulp p50, {:.3g} "
        "p99, {:.3g} max\n  geometric normals apart by {:.2g} degrees p50, {:.2g} p99, {:.2g} max",
        d.patch_mismatches, d.bit_equal, d.pixels, d.ulp.p50, d.ulp.p99, d.ulp.max,
        d.normal_degrees.p50, d.normal_degrees.p99, d.normal_degrees.max);
  }
  return text +
         fmt::format("\n  colour RMSE {:.3g} and largest difference {:.3g} of 255, PSNR {} dB\n",
                     c.color_rmse, c.color_max,
                     std::isinf(c.psnr) ? "infinite" : fmt::format("{:.1f}", c.psnr));
}

Frame comparison_picture(const Frame& a, const Frame& b) {
  expect_same_size(a, b);
  const double largest = color_difference(a, b).largest_number;
  const auto gain = static_cast<float>(largest > 0.0 ? 255.0 / largest : 0.0);
  Frame picture;
  picture.width = 2 * a.width;
  picture.height = 2 * a.height;
  picture.colors.resize(std::size_t{picture.width} * picture.height);
  for (uint32_t y = 0; y < a.height; ++y) {
    for (uint32_t x = 0; x < a.width; ++x) {
      const std::size_t i = std::size_t{y} * a.width + x;
      const auto at = [&](std::size_t right, std::size_t down) -> vec4& {
        return picture.colors[(y + down * a.height) * picture.width + x + right * a.width];
      };
      at(0, 0) = a.colors[i];
      at(1, 0) = b.colors[i];
      at(0, 1) = vec4(glm::abs(glm::vec3(a.colors[i]) - glm::vec3(b.colors[i])) * gain, 1.0F);
      at(1, 1) = mask_color(a, b, i);
    }
  }
  return picture;
}

}  // namespace trisect
