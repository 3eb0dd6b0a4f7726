#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/cli/cache_folder.h"
#include "app/cli/commands.h"
#include "app/cli/comparison_report.h"
#include "app/cli/load_scene.h"
#include "app/cli/output.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/pipeline_store.h"
#include "app/trace/trace_scene.h"

namespace trisect {

Tolerance tolerance_between(Backend a, Backend b, GlPath gl_path) {
  const auto either = [&](Backend backend) { return a == backend || b == backend; };
  // Frames differ from the oracle's on edges that two triangles share, where either may be hit, and
  // at pixels that single precision cannot decide. OpenGL's fragment path interpolates its rays,
  // which differ from the kernel's by a few roundings: pixels on an outline or an edge may change.
  Tolerance tolerance{.nan_pixels = 0.0};
  if (either(Backend::oracle)) {
    tolerance.hit_mismatches = 2e-4;
    tolerance.patch_mismatches = 5e-4;
    tolerance.color_rmse = 0.25;
  } else if (either(Backend::opengl) && gl_path == GlPath::fragment) {
    tolerance.hit_mismatches = 1e-4;
    tolerance.patch_mismatches = 5e-4;
    tolerance.color_rmse = 0.25;
  } else {
    tolerance.hit_mismatches = 0.0;
    tolerance.patch_mismatches = 0.0;
    tolerance.z_differs = 1e-4;
    tolerance.color_max = 1.0;
  }
  return tolerance;
}

int crosscheck(const CrosscheckOptions& options) {
  const RenderOptions& render = options.render;
  const bool has_vulkan = std::find(options.backends.begin(), options.backends.end(),
                                    Backend::vulkan) != options.backends.end();
  if (render.accel && *render.accel != Accel::list && !has_vulkan) {
    throw UsageError(
        fmt::format("--accel {}: none of the back ends is vulkan.", accel_name(*render.accel)));
  }
  begin_outputs({render.model}, {options.json, options.diff});
  ComparisonFiles files(options.json, options.diff);
  LoadedScene loaded = load_scene(render);
  std::vector<TraceResult> results;
  std::vector<Accel> accels;
  for (const Backend backend : options.backends) {
    // The others trace every patch.
    RenderOptions own = render;
    if (backend != Backend::vulkan) own.accel = Accel::list;
    const Accel accel = accel_for(own, backend, loaded.scene);
    accels.push_back(accel);
    if (needs_bvh(accel, render.shadows)) add_bvh(loaded);
    results.push_back(trace_showing_progress(
        {backend, render.gl_path, render.device, false, 1, false, cache_folder()}, loaded.scene,
        loaded.params, {render.solver, true, false, accel, render.shadows}));
    const std::string path = backend != Backend::opengl           ? ""
                             : render.gl_path == GlPath::fragment ? " (fragment)"
                                                                  : " (compute)";
    say("{}{}: {}, {}\n", backend_name(backend), path, results.back().device,
        results.back().driver);
  }

  nlohmann::ordered_json json{{"model", render.model},
                              {"backends", nlohmann::ordered_json::array()}};
  for (std::size_t i = 0; i < results.size(); ++i) {
    json["backends"].push_back({{"backend", backend_name(options.backends[i])},
                                {"device", results[i].device},
                                {"driver", results[i].driver},
                                {"accel", accel_name(accels[i])}});
  }
  bool kept = true;
  for (std::size_t i = 0; i < results.size(); ++i) {
    for (std::size_t j = i + 1; j < results.size(); ++j) {
      const Backend a = options.backends[i];
      const Backend b = options.backends[j];
      json["pairs"].push_back(report_pair(backend_name(a), results[i].frame, backend_name(b),
                                          results[j].frame,
                                          tolerance_between(a, b, render.gl_path)));
      kept = kept && json["pairs"].back()["excesses"].empty();
    }
  }
  files.write(json, results[0].frame, results[1].frame);
  return kept ? exit_done : exit_different;
}

}  // namespace trisect
