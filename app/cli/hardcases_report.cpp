#include "app/cli/hardcases_report.h"

#include "app/buffers/kernel_choice.h"
#include "app/surface/surface_choice.h"

namespace trisect {

const report::Columns<StressRow>& hardcases_columns() {
  // clang-format off
  static const report::Columns<StressRow> columns{
      {{}, "case", {"case", "{}"}, [](auto& r) { return r.name; }, {"case", "{}", -23}},
      {{}, "what", {}, [](auto& r) { return r.what; }},
      {{}, "kind", {}, [](auto& r) { return kind_name(r.kind); }},
      {{}, "surface", {"surface", "{}"}, [](auto& r) { return surface_name(r.surface); }, {"surface", "{}", -7}},
      {{}, "shell", {"shell", "{}"}, [](auto& r) { return shell_name(r.shell); }, {"shell", "{}", -7}},
      {{}, "solver", {"solver", "{}"}, [](auto& r) { return solver_name(r.solver); }, {"solver", "{}", -7}},
      {{}, "rank", {}, [](auto& r) { return r.rank; }},
      {{}, "rays", {"rays", "{}"}, [](auto& r) { return r.outcome.rays; }, {"rays", "{}", 5}},
      {{}, "undecidable", {"undecidable", "{}"}, [](auto& r) { return r.outcome.undecidable; }, {"undec.", "{}", 6}},
      {{}, "most_undecidable", {}, [](auto& r) { return r.most_undecidable; }},
      {{}, "wrong", {"wrong", "{}"}, [](auto& r) { return r.outcome.wrong; }, {"wrong", "{}", 6}},
      {{}, "missed", {"missed", "{}"}, [](auto& r) { return r.outcome.missed; }, {"missed", "{}", 6}},
      {{}, "depth_error_ulp_p50", {"p50 ulp", "{:.3g}"}, [](auto& r) { return r.error_ulp(0.5); }, {"p50 ulp", "{:.3g}", 8}},
      {{}, "depth_error_ulp_p99", {"p99 ulp", "{:.3g}"},
       [](auto& r) { return r.error_ulp(0.99); }, {"p99 ulp", "{:.3g}", 8}},
      {{}, "depth_error_ulp_max", {"max ulp", "{:.3g}"}, [](auto& r) { return r.error_ulp(1.0); }, {"max ulp", "{:.3g}", 9}},
      {{}, "nans", {"NaNs", "{}"}, [](auto& r) { return r.outcome.nans; }, {"NaNs", "{}", 5}},
      {{}, "evaluations_per_ray", {"evaluations a ray", "{:.3g}"},
       [](auto& r) { return r.evaluations_per_ray(); }, {"eval/ray", "{:.1f}", 8}},
      {{}, "verdict", {"verdict", "{}"}, [](auto& r) { return r.verdict; }},
      {{}, "note", {}, [](auto& r) { return r.outcome.note; }},
      // With a second blank before it.
      {{}, "", {}, [](auto& r) { return with_note(r.verdict, r.outcome.note); }, {" verdict", " {}"}},
  };
  // clang-format on
  return columns;
}

std::string with_note(const std::string& verdict, const std::string& note) {
  return note.empty() ? verdict : verdict + " (" + note + ")";
}

}  // namespace trisect
