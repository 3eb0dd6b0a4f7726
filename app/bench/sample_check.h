// A quick check that a frame shows what the oracle sees, at a grid of its pixels.
#pragma once

#include <cstddef>

#include "app/bake/bake.h"
#include "app/base/keep_going.h"
#include "app/frame/frame.h"
#include "app/oracle/oracle.h"
#include "app/surface/shared.h"

namespace trisect::bench {

class SampleCheck {
 public:
  // Asks the oracle about every `step`-th pixel of every `step`-th row, on all cores. progress: as
  // for parallel_rows, of the grid's rows; if it returns false, Interrupted is thrown.
  SampleCheck(const BakedScene& scene, const TraceParams& params, uint32_t step,
              const Progress& progress);

  // How many pixels are checked: those of the grid that the oracle decides.
  [[nodiscard]] std::size_t pixels() const { return pixels_.size(); }

  // How many of these are wrong: hit by only one of frame and oracle, off by more than two steps of
  // 8 bits (2/255) in a component of the colour, or NaN. frame: rendered with the constructor's
  // params; it needs no AOVs. Thread-safe.
  [[nodiscard]] std::size_t count_wrong(const Frame& frame) const;

 private:
  std::vector<std::size_t> pixels_;
  Frame truth_;
};

}  // namespace trisect::bench
