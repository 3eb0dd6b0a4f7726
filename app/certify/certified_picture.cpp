#include "app/certify/certified_picture.h"

#include <string>
#include <utility>

#include "app/accuracy/accuracy.h"
#include "app/frame/draw_text.h"

namespace trisect {
namespace {

const vec4 kWrong(1.0F);
const vec4 kInk(0.9F, 0.9F, 0.9F, 1.0F);

// Misses are blue, hits green, what is open has a colour of its own.
vec4 color_of(Reason reason) {
  switch (reason) {
    case Reason::nothing_near:
      return {0.05F, 0.06F, 0.10F, 1.0F};
    case Reason::hulls:
      return {0.12F, 0.22F, 0.48F, 1.0F};
    case Reason::contraction:
      return {0.20F, 0.48F, 0.78F, 1.0F};
    case Reason::one_root:
      return {0.18F, 0.45F, 0.24F, 1.0F};
    case Reason::border:
      return {0.98F, 0.85F, 0.20F, 1.0F};
    case Reason::fold:
      return {0.92F, 0.22F, 0.18F, 1.0F};
    case Reason::nonsmooth:
      return {0.85F, 0.25F, 0.85F, 1.0F};
    case Reason::ray_start:
      return {0.55F, 0.36F, 0.20F, 1.0F};
    default:
      return {1.0F, 0.55F, 0.10F, 1.0F};
  }
}

void draw_key(uint32_t top, Frame& picture) {
  uint32_t x = 2;
  uint32_t y = top + 2;
  const auto draw = [&](const vec4& color, const std::string& text) {
    fill_rectangle(x, y + 2, 8, 8, color, picture);
    x = draw_text(x + 10, y, text, kInk, picture) + 6;
  };
  const auto next_row = [&] {
    x = 2;
    y += kReasonKeyHeight / 3;
  };
  draw(color_of(Reason::nothing_near), "miss: nothing near");
  draw(color_of(Reason::hulls), "hulls");
  draw(color_of(Reason::contraction), "contraction");
  next_row();
  draw(color_of(Reason::one_root), "hit: one root");
  draw(kWrong, "wrong");
  next_row();
  draw(color_of(Reason::border), "open: border");
  for (const Reason reason : {Reason::fold, Reason::nonsmooth, Reason::ray_start, Reason::order}) {
    draw(color_of(reason), reason_name(reason));
  }
}

}  // namespace

ReasonCounts count_reasons(const CertifiedFrame& proofs) {
  ReasonCounts counts{};
  for (const CertifiedAnswer& answer : proofs.pixels) {
    ++counts[static_cast<std::size_t>(answer.reason)];
  }
  return counts;
}

CertifiedAnswers judge_answers(const Frame& frame, const CertifiedFrame& proofs,
                               const BakedScene& scene, const TraceParams& params) {
  OracleFrame truth{proofs.width, proofs.height, {}};
  truth.pixels.reserve(proofs.pixels.size());
  for (const CertifiedAnswer& answer : proofs.pixels) truth.pixels.push_back(answer.answer());
  CertifiedAnswers answers;
  std::vector<double> off_surface;
  for (std::size_t i = 0; i < proofs.pixels.size(); ++i) {
    const ClassifiedRay ray = classify_pixel(frame, truth, i, params, scene.radius);
    switch (ray.verdict) {
      case RayVerdict::undecidable:
        ++answers.open;
        break;
      case RayVerdict::both_miss:
        ++answers.right_misses;
        break;
      case RayVerdict::hit:
        ++answers.right_hits;
        off_surface.push_back(ray.off_surface);
        break;
      default:
        answers.wrong.push_back({static_cast<uint32_t>(i % proofs.width),
                                 static_cast<uint32_t>(i / proofs.width), ray.verdict});
    }
  }
  answers.off_surface = quantiles_of(std::move(off_surface));
  return answers;
}

Frame reason_picture(const CertifiedFrame& proofs, const CertifiedAnswers& answers) {
  Frame picture;
  picture.resize(proofs.width, proofs.height + kReasonKeyHeight, false);
  fill_rectangle(0, proofs.height, proofs.width, kReasonKeyHeight, vec4(0.0F, 0.0F, 0.0F, 1.0F),
                 picture);
  for (std::size_t i = 0; i < proofs.pixels.size(); ++i) {
    picture.colors[i] = color_of(proofs.pixels[i].reason);
  }
  for (const CertifiedAnswers::Wrong& wrong : answers.wrong) {
    picture.colors[std::size_t{wrong.y} * proofs.width + wrong.x] = kWrong;
  }
  draw_key(proofs.height, picture);
  return picture;
}

}  // namespace trisect
