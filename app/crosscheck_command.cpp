#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/atomic_file.h"
#include "app/commands.h"
#include "app/difference_file.h"
#include "app/error.h"
#include "app/frame_comparison.h"
#include "app/load_scene.h"
#include "app/trace_scene.h"

namespace trisect {

Tolerance tolerance_between(Backend a, Backend b, GlPath gl_path) {
  const auto either = [&](Backend backend) { return a == backend || b == backend; };
  // The oracle has ties on shared edges and pixels that single precision cannot decide. Rays that
  // OpenGL interpolates are others, by some roundings: pixels on an outline or an edge may turn.
  if (either(Backend::oracle)) return {2e-4, 5e-4, Tolerance::kAny, 0.25, Tolerance::kAny};
  if (either(Backend::opengl) && gl_path == GlPath::fragment) {
    return {1e-4, 5e-4, Tolerance::kAny, 0.25, Tolerance::kAny};
  }
  return {0.0, 0.0, 1e-4, Tolerance::kAny, 1.0};
}

int crosscheck(const CrosscheckOptions& options) {
  const RenderOptions& render = options.render;
  const LoadedScene loaded = load_scene(render);
  std::vector<TraceResult> results;
  for (const Backend backend : options.backends) {
    results.push_back(trace_scene({backend, render.gl_path, render.device, false, 1, false},
                                  loaded.scene, loaded.params, {render.solver, true, false}));
    const std::string path = backend != Backend::opengl           ? ""
                             : render.gl_path == GlPath::fragment ? " (fragment)"
                                                                  : " (compute)";
    fmt::print("{}{}: {}, {}\n", backend_name(backend), path, results.back().device,
               results.back().driver);
  }

  nlohmann::ordered_json json{{"model", render.model},
                              {"backends", nlohmann::ordered_json::array()}};
  for (std::size_t i = 0; i < results.size(); ++i) {
    json["backends"].push_back({{"backend", backend_name(options.backends[i])},
                                {"device", results[i].device},
                                {"driver", results[i].driver}});
  }
  bool kept = true;
  for (std::size_t i = 0; i < results.size(); ++i) {
    for (std::size_t j = i + 1; j < results.size(); ++j) {
      const Backend a = options.backends[i];
      const Backend b = options.backends[j];
      const FrameComparison comparison = compare(results[i].frame, results[j].frame);
      const std::vector<std::string> found =
          excesses(comparison, tolerance_between(a, b, render.gl_path));
      kept = kept && found.empty();
      fmt::print("{} | {}\n{}", backend_name(a), backend_name(b), to_text(comparison));
      for (const std::string& excess : found) fmt::print("  too far apart: {}\n", excess);
      nlohmann::ordered_json pair{{"a", backend_name(a)}, {"b", backend_name(b)}};
      pair.update(to_json(comparison));
      pair["excesses"] = found;
      json["pairs"].push_back(pair);
    }
  }
  std::optional<AtomicFile> file;
  if (!options.json.empty()) {
    file.emplace(options.json);
    file->write(json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  }
  if (!options.diff.empty()) write_difference(results[0].frame, results[1].frame, options.diff);
  if (file) file->commit();
  return kept ? exit_done : exit_different;
}

}  // namespace trisect
