#include "app/crosscheck/frame_comparison.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "app/base/ulp.h"
#include "app/crosscheck/pixel_comparison.h"

namespace trisect {
namespace {

FrameComparison::Depth compare_depth(const Frame& a, const Frame& b) {
  FrameComparison::Depth depth;
  std::vector<double> lengths;
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
    const double length = apart(za, zb);
    lengths.push_back(length);
    ulp.push_back(length == 0.0 ? 0.0 : length / ulp_of(za));
    const glm::dvec3 normal(p.geometric_u);
    const glm::dvec3 other(q.geometric_u);
    degrees.push_back(normal == other ? 0.0 : degrees_between(normal, other));
  }
  depth.z_apart = quantiles_of(std::move(lengths));
  depth.ulp = quantiles_of(std::move(ulp));
  depth.normal_degrees = quantiles_of(std::move(degrees));
  return depth;
}

// A share of nothing is 0.
double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

FrameComparison compare(const Frame& a, const Frame& b) {
  expect_same_size(a, b);
  FrameComparison result;
  result.pixels = a.colors.size();
  result.tells_hits = !a.aovs.empty() || !b.aovs.empty();
  for (std::size_t i = 0; i < a.colors.size(); ++i) {
    const bool hit_a = is_hit(a, i);
    const bool hit_b = is_hit(b, i);
    if (hit_a || hit_b) ++result.hits;
    if (hit_a != hit_b) ++result.hit_mismatches;
    if (!hit_a || !hit_b) result.tells_hits = true;
  }
  const ColorDifference color = color_difference(a, b);
  result.color_rmse = color.rmse;
  result.color_max = color.largest;
  result.alpha_max = color.alpha;
  result.nan_pixels = color.nan_pixels;
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
  limit("largest difference of alpha, 8-bit steps", comparison.alpha_max, tolerance.alpha_max);
  limit("pixels that are NaN in both, of the pixels",
        share(comparison.nan_pixels, comparison.pixels), tolerance.nan_pixels);
  return found;
}

std::string to_text(const FrameComparison& c) {
  std::string text = fmt::format("  {} pixels", c.pixels);
  if (c.tells_hits) text += fmt::format(", {} hit, {} hit mismatches", c.hits, c.hit_mismatches);
  if (c.depth) {
    const FrameComparison::Depth& d = *c.depth;
    const auto list = [](const Quantiles& q) {
      return fmt::format("{:.3g} p50, {:.3g} p99, {:.3g} max", q.p50, q.p99, q.max);
    };
    text += fmt::format(
        ", {} patch mismatches\n  Z of the same bits in {} of {}, apart by {} in the model's "
        "units, "
        "by {} in ulps\n  geometric normals apart by {} degrees",
        d.patch_mismatches, d.bit_equal, d.pixels, list(d.z_apart), list(d.ulp),
        list(d.normal_degrees));
  }
  text += fmt::format("\n  colour RMSE {:.3g} and largest difference {:.3g} of 255, PSNR {} dB",
                      c.color_rmse, c.color_max,
                      std::isinf(c.psnr) ? "infinite" : fmt::format("{:.1f}", c.psnr));
  if (c.alpha_max != 0.0) text += fmt::format(", alpha apart by up to {:.3g} of 255", c.alpha_max);
  if (c.nan_pixels > 0) text += fmt::format("\n  {} pixels are NaN in both", c.nan_pixels);
  return text + "\n";
}

}  // namespace trisect
