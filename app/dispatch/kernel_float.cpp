#include "app/dispatch/kernel_float.h"

#include "app/bake/subpatch_bounds.h"

namespace trisect::in_float {

Kernel kernel_of(const BakedScene& scene, const TraceParams& params, const KernelChoice& choice) {
  return {params,
          scene.triangles.data(),
          scene.subpatches.data(),
          scene.choice.surface,
          scene.choice.shell,
          choice.solver,
          choice.writes_aovs(),
          choice.counts,
          has_divided_patches(scene),
          has_nonsmooth(scene),
          false};
}

}  // namespace trisect::in_float
