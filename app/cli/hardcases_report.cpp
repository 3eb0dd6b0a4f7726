#include "app/cli/hardcases_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/buffers/kernel_choice.h"
#include "app/surface/surface_choice.h"

namespace trisect {

std::string hardcases_header() {
  return fmt::format(
      "{:<23} {:<7} {:<7} {:<7} {:>5} {:>6} {:>6} {:>6} {:>8} {:>8} {:>9} {:>5} {:>8}  {}\n",
      "case", "surface", "shell", "solver", "rays", "undec.", "wrong", "missed", "p50 ulp",
      "p99 ulp", "max ulp", "NaNs", "eval/ray", "verdict");
}

std::string hardcases_row(const StressRow& row) {
  const CheckedOutcome& outcome = row.outcome;
  return fmt::format(
      "{:<23} {:<7} {:<7} {:<7} {:>5} {:>6} {:>6} {:>6} {:>8.3g} {:>8.3g} {:>9.3g} {:>5} {:>8.1f}  "
      "{}{}\n",
      row.name, surface_name(row.surface), shell_name(row.shell), solver_name(row.solver),
      outcome.rays, outcome.undecidable, outcome.wrong, outcome.missed, row.error_ulp(0.5),
      row.error_ulp(0.99), row.error_ulp(1.0), outcome.nans, row.evaluations_per_ray(), row.verdict,
      outcome.note.empty() ? "" : fmt::format(" ({})", outcome.note));
}

nlohmann::ordered_json json_of(const StressRow& row) {
  const CheckedOutcome& outcome = row.outcome;
  return {{"case", row.name},
          {"what", row.what},
          {"kind", kind_name(row.kind)},
          {"surface", surface_name(row.surface)},
          {"shell", shell_name(row.shell)},
          {"solver", solver_name(row.solver)},
          {"rank", row.rank},
          {"rays", outcome.rays},
          {"undecidable", outcome.undecidable},
          {"wrong", outcome.wrong},
          {"missed", outcome.missed},
          {"depth_error_ulp_p50", row.error_ulp(0.5)},
          {"depth_error_ulp_p99", row.error_ulp(0.99)},
          {"depth_error_ulp_max", row.error_ulp(1.0)},
          {"nans", outcome.nans},
          {"evaluations_per_ray", row.evaluations_per_ray()},
          {"verdict", row.verdict},
          {"note", outcome.note}};
}

}  // namespace trisect
