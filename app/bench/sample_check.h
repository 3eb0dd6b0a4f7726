// Whether a frame shows what the oracle sees, at a grid of its pixels.
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
  // Asks the oracle about every `step`-th pixel of every `step`-th row. progress: as parallel_rows
  // has it, of the frame's rows; if it says stop Interrupted is thrown.
  SampleCheck(const BakedScene& scene, const TraceParams& params, uint32_t step,
              const Progress& progress);

  // Pixels that it knows: the decidable ones of the grid.
  [[nodiscard]] std::size_t pixels() const { return pixels_.size(); }

  // Of these, those that are hit by one only, or have a colour more than two steps of 8 bits off.
  [[nodiscard]] std::size_t count_wrong(const Frame& frame) const;

 private:
  std::vector<std::size_t> pixels_;
  Frame truth_;
};

}  // namespace trisect::bench
