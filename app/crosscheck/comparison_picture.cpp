#include "app/crosscheck/comparison_picture.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include "app/crosscheck/pixel_comparison.h"
#include "app/frame/draw_text.h"

namespace trisect {
namespace {

const vec4 kRed(1.0F, 0.0F, 0.0F, 1.0F);
const vec4 kYellow(1.0F, 1.0F, 0.0F, 1.0F);
const vec4 kBlue(0.3F, 0.5F, 1.0F, 1.0F);
const vec4 kGrey(0.35F, 0.35F, 0.35F, 1.0F);
const vec4 kBlack(0.0F, 0.0F, 0.0F, 1.0F);
const vec4 kWhite(1.0F);

vec4 mask_color(const Frame& a, const Frame& b, std::size_t pixel) {
  const bool hit_a = is_hit(a, pixel);
  const bool hit_b = is_hit(b, pixel);
  if (hit_a != hit_b) return kRed;
  if (!hit_a) return kBlack;
  if (!a.aovs.empty() && !b.aovs.empty()) {
    const PixelAovs& p = a.aovs[pixel];
    const PixelAovs& q = b.aovs[pixel];
    if (p.triangle != q.triangle) return kYellow;
    if (!same_bits(p.normal_z.w, q.normal_z.w)) return kBlue;
  }
  return kGrey;
}

// The scale of the difference on the left, the mask's colours on the right.
void draw_key(const std::string& scale, uint32_t top, Frame& picture) {
  const uint32_t y = top + (kComparisonKeyHeight - kTextHeight) / 2 + 1;
  const uint32_t middle = picture.width / 2;
  uint32_t x = draw_text(2, y, "0", kWhite, picture) + 2;
  constexpr uint32_t bar = 48;
  for (uint32_t i = 0; i < bar && x + i < middle; ++i) {
    const float level = static_cast<float>(i) / static_cast<float>(bar - 1);
    fill_rectangle(x + i, top + 3, 1, kComparisonKeyHeight - 6, vec4(vec3(level), 1.0F), picture);
  }
  draw_text(x + bar + 2, y, scale, kWhite, picture);
  fill_rectangle(middle, top, picture.width - middle, kComparisonKeyHeight, kBlack, picture);
  x = middle + 2;
  for (const auto& [color, text] :
       {std::pair(kRed, "one hits"), std::pair(kYellow, "other triangle"),
        std::pair(kBlue, "other Z"), std::pair(kGrey, "alike")}) {
    fill_rectangle(x, top + 4, 8, 8, color, picture);
    x = draw_text(x + 10, y, text, kWhite, picture) + 6;
  }
}

std::string scale_of(const ColorDifference& difference) {
  const double white = difference.largest_number;
  const std::string scale = white > 0.0
                                ? fmt::format("{:.3g} of 255, x{:.3g}", white, 255.0 / white)
                                : std::string("no difference");
  return std::isfinite(difference.largest) ? scale : scale + ", some not finite";
}

}  // namespace

std::string comparison_scale(const Frame& a, const Frame& b) {
  return scale_of(color_difference(a, b));
}

Frame comparison_picture(const Frame& a, const Frame& b) {
  expect_same_size(a, b);
  const ColorDifference difference = color_difference(a, b);
  const double largest = difference.largest_number;
  const double gain = largest > 0.0 ? 255.0 / largest : 0.0;
  Frame picture;
  picture.resize(2 * a.width, 2 * a.height + kComparisonKeyHeight, false);
  picture.colors.assign(picture.colors.size(), kBlack);
  for (uint32_t y = 0; y < a.height; ++y) {
    for (uint32_t x = 0; x < a.width; ++x) {
      const std::size_t i = std::size_t{y} * a.width + x;
      const auto at = [&](std::size_t right, std::size_t down) -> vec4& {
        return picture.colors[(y + down * a.height) * picture.width + x + right * a.width];
      };
      at(0, 0) = a.colors[i];
      at(1, 0) = b.colors[i];
      at(0, 1) =
          vec4(glm::abs(glm::vec3(a.colors[i]) - glm::vec3(b.colors[i])) * static_cast<float>(gain),
               1.0F);
      at(1, 1) = mask_color(a, b, i);
    }
  }
  draw_key(scale_of(difference), 2 * a.height, picture);
  return picture;
}

}  // namespace trisect
