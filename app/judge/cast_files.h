// Rays of files, cast by the program's own solvers.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "app/bake/bake.h"
#include "app/base/keep_going.h"
#include "app/judge/ray_file.h"
#include "app/oracle/oracle.h"

namespace trisect {

// What casts rays: one hit for each, in their order.
using Caster = std::function<std::vector<CastHit>(std::span<const CastRay>)>;

// The first hit of each ray, in their order, by what casts rays in the scene (RayCaster,
// cast_on_cpu), which may be baked about any origin: rays are moved there in double precision.
// progress counts rays; nothing is returned if it stops the work.
std::optional<std::vector<FileHit>> cast_file_rays(const BakedScene& scene,
                                                   std::span<const FileRay> rays,
                                                   const Caster& caster, const Progress& progress);

// The same by the oracle, in double precision and on all cores.
std::optional<std::vector<FileHit>> cast_by_oracle(const BakedScene& scene,
                                                   std::span<const FileRay> rays,
                                                   const Progress& progress);

// A ray for the oracle: its origin seen from the scene's, its direction of unit length.
OracleRay to_oracle_ray(const BakedScene& scene, const FileRay& ray);

}  // namespace trisect
