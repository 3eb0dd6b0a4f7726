// Differences of pictures, against their formulas.
#include "app/bench/image_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace trisect::bench {
namespace {

Frame frame_of_color(float red, float green, float blue) {
  Frame frame;
  frame.resize(20, 15, false);
  std::fill(frame.colors.begin(), frame.colors.end(), vec4(red, green, blue, 1.0F));
  return frame;
}

TEST(ImageErrors, AreThoseOfTheirFormulas) {
  const Frame dark = frame_of_color(0.2F, 0.2F, 0.2F);
  const Frame light = frame_of_color(0.6F, 0.6F, 0.6F);
  EXPECT_NEAR(structural_similarity(dark, dark), 1.0, 1e-12);
  EXPECT_EQ(relative_square_error(dark, dark), 0.0);
  // Without contrast only the means count.
  EXPECT_NEAR(structural_similarity(dark, light), (2.0 * 0.2 * 0.6 + 1e-4) / (0.04 + 0.36 + 1e-4),
              1e-6);
  // 0.2 and 0.6 are 0.0331048 and 0.318547 in linear light.
  EXPECT_NEAR(relative_square_error(dark, light),
              std::pow(0.318547 - 0.0331048, 2) / (std::pow(0.318547, 2) + 0.01), 1e-5);
  // Contrast without correlation is similar in nothing but the mean.
  Frame stripes = light;
  for (std::size_t i = 0; i < stripes.colors.size(); i += 2) stripes.colors[i] = vec4(0.5F);
  EXPECT_LT(structural_similarity(stripes, light), 0.5);
}

double luma(const Frame& frame, int x, int y) {
  const vec4& color = frame.colors[static_cast<std::size_t>(y) * 20 + static_cast<std::size_t>(x)];
  return 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
}

// Equation 13 with every window summed up by itself.
double similarity_by_definition(const Frame& a, const Frame& b) {
  double sum = 0.0;
  for (int y = 0; y < 15; ++y) {
    for (int x = 0; x < 20; ++x) {
      double weight = 0.0;
      double ma = 0.0;
      double mb = 0.0;
      double aa = 0.0;
      double bb = 0.0;
      double ab = 0.0;
      for (int j = std::max(y - 5, 0); j <= std::min(y + 5, 14); ++j) {
        for (int i = std::max(x - 5, 0); i <= std::min(x + 5, 19); ++i) {
          const double w = std::exp(-((x - i) * (x - i) + (y - j) * (y - j)) / (2.0 * 1.5 * 1.5));
          weight += w;
          ma += w * luma(a, i, j);
          mb += w * luma(b, i, j);
          aa += w * luma(a, i, j) * luma(a, i, j);
          bb += w * luma(b, i, j) * luma(b, i, j);
          ab += w * luma(a, i, j) * luma(b, i, j);
        }
      }
      ma /= weight;
      mb /= weight;
      sum += (2.0 * ma * mb + 1e-4) * (2.0 * (ab / weight - ma * mb) + 9e-4) /
             ((ma * ma + mb * mb + 1e-4) * (aa / weight - ma * ma + bb / weight - mb * mb + 9e-4));
    }
  }
  return sum / 300.0;
}

TEST(ImageErrors, HaveTheWindowOfTheirSource) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> any(0.0F, 1.0F);
  Frame a = frame_of_color(0.0F, 0.0F, 0.0F);
  Frame b = a;
  for (std::size_t i = 0; i < a.colors.size(); ++i) {
    a.colors[i] = vec4(any(random), any(random), any(random), 1.0F);
    b.colors[i] = 0.7F * a.colors[i] + 0.3F * vec4(any(random));
  }
  EXPECT_NEAR(structural_similarity(a, b), similarity_by_definition(a, b), 1e-12);
}

}  // namespace
}  // namespace trisect::bench
