// The CPU back end: the kernel's own source in C++, single precision, one thread a core.
#pragma once

#include <span>
#include <vector>

#include "app/bake/bake.h"
#include "app/base/keep_going.h"
#include "app/buffers/kernel_choice.h"
#include "app/frame/frame.h"
#include "app/surface/shared.h"

namespace trisect {

// Renders into `frame`. progress: as parallel_rows has it, of rows; false: it stopped the frame,
// some of which is not written.
bool trace_on_cpu(const BakedScene& scene, const TraceParams& params, const KernelChoice& choice,
                  Frame& frame, const Progress& progress = {});

// One hit for each ray, as RayCaster casts them.
std::vector<CastHit> cast_on_cpu(const BakedScene& scene, const TraceParams& params, uint solver,
                                 std::span<const CastRay> rays);

}  // namespace trisect
