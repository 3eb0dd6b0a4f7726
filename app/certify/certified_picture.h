// What a picture's pixels show, held against what is proven.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "app/accuracy/classify.h"
#include "app/base/quantiles.h"
#include "app/certify/certifier.h"
#include "app/frame/frame.h"

namespace trisect {

// Pixels with each reason, in the order of kReasons.
using ReasonCounts = std::array<std::size_t, kReasons.size()>;
ReasonCounts count_reasons(const CertifiedFrame& proofs);

// A back end's answers, by the rules of classify(). What is not proven is judged by nobody, unless
// it is not a number.
struct CertifiedAnswers {
  struct Wrong {
    uint32_t x;
    uint32_t y;
    RayVerdict verdict;
  };

  std::size_t right_hits = 0;
  std::size_t right_misses = 0;
  std::size_t open = 0;
  std::vector<Wrong> wrong;  // row by row
  Quantiles off_surface;     // of the right hits: |depth error| |n.d| over the scene's radius
};

// frame: with AOVs, of the proofs' size, rendered of this scene with params.
CertifiedAnswers judge_answers(const Frame& frame, const CertifiedFrame& proofs,
                               const BakedScene& scene, const TraceParams& params);

// The rows below the picture.
constexpr uint32_t kReasonKeyHeight = 48;

// The reason of each pixel as a colour, those with a wrong answer white, and under them
// kReasonKeyHeight rows that say which colour is what.
Frame reason_picture(const CertifiedFrame& proofs, const CertifiedAnswers& answers);

}  // namespace trisect
