// The CPU back end: the kernel's own source compiled as C++ in single precision, one thread per
// core.
#pragma once

#include <span>
#include <vector>

#include "app/bake/bake.h"
#include "app/base/keep_going.h"
#include "app/buffers/kernel_choice.h"
#include "app/frame/frame.h"
#include "app/surface/shared.h"

namespace trisect {

// Renders into `frame`, which gets the size that `params` says. progress: called as parallel_rows()
// calls it, with rows. Returns false if it stopped the frame, of which some rows are then missing;
// a ray that is on its way stops within a tenth of a second.
bool trace_on_cpu(const BakedScene& scene, const TraceParams& params, const KernelChoice& choice,
                  Frame& frame, const Progress& progress = {});

// The first hit of each ray, as RayCaster finds it.
std::vector<CastHit> cast_on_cpu(const BakedScene& scene, const TraceParams& params, uint solver,
                                 std::span<const CastRay> rays);

}  // namespace trisect
