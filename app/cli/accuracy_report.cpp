#include "app/cli/accuracy_report.h"

#include "app/buffers/kernel_choice.h"
#include "app/mesh/obj_file.h"

namespace trisect {

// A column stands twice where the outputs show different values.
const report::Columns<AccuracyRow>& accuracy_columns() {
  // clang-format off
  static const report::Columns<AccuracyRow> columns{
      {{}, "model", {}, [](auto& r) { return r.model; }},
      {{}, "", {"model", "{}"}, [](auto& r) { return model_name(r.model); }},
      {{}, "surface", {"surface", "{}"}, [](auto& r) { return surface_name(r.choice.surface); }},
      {{}, "shell", {"shell", "{}"}, [](auto& r) { return shell_name(r.choice.shell); }},
      {{}, "solver", {"solver", "{}"}, [](auto& r) { return solver_name(r.solver); }},
      {{}, "pixels", {}, [](auto& r) { return r.accuracy.pixels; }},
      {{}, "hits", {"hit", "{}"}, [](auto& r) { return r.accuracy.hits; }},
      {{}, "undecidable", {"undecidable", "{}"}, [](auto& r) { return r.accuracy.undecidable; }},
      {{}, "wrong_hits", {"wrong hit", "{}"}, [](auto& r) { return r.accuracy.wrong_hits; }},
      {{}, "missed", {"missed", "{}"}, [](auto& r) { return r.accuracy.missed; }},
      {{}, "wrong_patches", {"wrong patch", "{}"}, [](auto& r) { return r.accuracy.wrong_patches; }},
      {{}, "nans", {}, [](auto& r) { return r.accuracy.nans; }},
      {{}, "off_surface.p50", {"off p50", "{:.1e}"}, [](auto& r) { return r.accuracy.off_surface.p50; }},
      {{}, "off_surface.p99", {"off p99", "{:.1e}"}, [](auto& r) { return r.accuracy.off_surface.p99; }},
      {{}, "off_surface.max", {"off max", "{:.1e}"}, [](auto& r) { return r.accuracy.off_surface.max; }},
      {{}, "depth_ulp.p50", {"ulp p50", "{:.2g}"}, [](auto& r) { return r.accuracy.depth_ulp.p50; }},
      {{}, "depth_ulp.p99", {"ulp p99", "{:.2g}"}, [](auto& r) { return r.accuracy.depth_ulp.p99; }},
      {{}, "depth_ulp.max", {}, [](auto& r) { return r.accuracy.depth_ulp.max; }},
      {{}, "normal_degrees.p50", {}, [](auto& r) { return r.accuracy.normal_degrees.p50; }},
      {{}, "normal_degrees.p99", {"normal p99", "{:.4f}"}, [](auto& r) { return r.accuracy.normal_degrees.p99; }},
      {{}, "normal_degrees.max", {}, [](auto& r) { return r.accuracy.normal_degrees.max; }},
      {{}, "evals_per_candidate", {"evals", "{:.1f}"}, [](auto& r) { return r.accuracy.median_evaluations; }},
      {{}, "cpu_differs", {"cpu differs", "{}"}, [](auto& r) { return r.cpu_differs; }},
      {{}, "gpu_ms", {"ms", "{:.0f}"}, [](auto& r) { return r.gpu_ms; }},
      {{}, "verdict", {"", "{}"}, [](auto& r) { return r.verdict; }},
  };
  // clang-format on
  return columns;
}

std::string accuracy_table_header() {
  std::string text = accuracy_columns().markdown_header();
  // The verdict has no title, only a blank between its bars.
  text.erase(text.find("|  |") + 1, 1);
  return text;
}

}  // namespace trisect
