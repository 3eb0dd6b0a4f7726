// The CPU back end: the kernel's own source in C++, single precision, one thread a core.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "app/bake.h"
#include "app/frame.h"
#include "app/kernel_choice.h"
#include "app/shared.h"

namespace trisect {

// Renders into `frame`. between_rows, if set, is called on the calling thread a few times a second
// with the rows that are done; what it throws stops the frame.
void trace_on_cpu(const BakedScene& scene, const TraceParams& params, const KernelChoice& choice,
                  Frame& frame, const std::function<void(uint32_t)>& between_rows = {});

// One hit for each ray, as RayCaster casts them.
std::vector<CastHit> cast_on_cpu(const BakedScene& scene, const TraceParams& params, uint solver,
                                 std::span<const CastRay> rays);

}  // namespace trisect
