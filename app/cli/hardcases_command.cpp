#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/base/atomic_file.h"
#include "app/base/error.h"
#include "app/cli/cache_folder.h"
#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/json_text.h"
#include "app/dispatch/pipeline_store.h"
#include "app/stress/stress_backend.h"
#include "app/stress/stress_judge.h"

namespace trisect {
namespace {

// The row's figures, in the order of the table's columns.
void print_header() {
  fmt::print("{:<23} {:<7} {:<7} {:<7} {:>5} {:>6} {:>6} {:>6} {:>8} {:>8} {:>9} {:>5} {:>8}  {}\n",
             "case", "surface", "shell", "solver", "rays", "undec.", "wrong", "missed", "p50 ulp",
             "p99 ulp", "max ulp", "NaNs", "eval/ray", "verdict");
}

void print_row(const StressRow& row) {
  const CheckedOutcome& outcome = row.outcome;
  fmt::print(
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
          {"most_undecidable", row.most_undecidable},
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

std::string to_json(const StressBackend& backend, const std::vector<StressRow>& rows) {
  nlohmann::ordered_json json;
  json["program"] = "trisect";
  json["version"] = TRISECT_VERSION;
  json["device"] = backend.device;
  json["driver"] = backend.driver;
  json["rows"] = nlohmann::ordered_json::array();
  for (const StressRow& row : rows) json["rows"].push_back(json_of(row));
  return json_text(json);
}

std::vector<StressRow> run_all(const StressBackend& backend) {
  std::vector<StressRow> rows;
  const auto add = [&](StressRow row) {
    print_row(row);
    rows.push_back(std::move(row));
    stop_if_interrupted();
  };
  for (const RayCase& stress : stress_ray_catalogue()) {
    for (const uint surface : stress.surfaces) {
      for (StressRow& row : run_rows(stress, surface, backend)) add(std::move(row));
    }
  }
  for (const CheckedCase& stress : stress_checked_cases()) add(run_row(stress, backend));
  return rows;
}

int run_on(const HardcasesOptions& options, const StressBackend& backend) {
  std::optional<AtomicFile> json;
  if (!options.json.empty()) json.emplace(options.json);
  fmt::print("device {}, driver {}\n", backend.device, backend.driver);
  print_header();
  const std::vector<StressRow> rows = run_all(backend);
  const BindingRows binding = count_binding(rows);
  fmt::print(
      "ulp: depth error across the surface, |dz| |n.v|, in units of 2^-23 of the scene's radius "
      "(of the eye's distance in images)\n"
      "{} of {} rows of the robust solver in the normal shell pass, {} undecided\n",
      binding.passed, binding.all, binding.undecided);
  if (json) {
    json->write(to_json(backend, rows));
    json->commit();
  }
  return binding.failed() == 0 ? exit_done : exit_different;
}

}  // namespace

int hardcases(const HardcasesOptions& options) {
  if (options.backend == Backend::cpu) return run_on(options, cpu_stress_backend());
  const gpu::Instance instance(false);
  const gpu::Device device(instance, options.device);
  const PipelineStore store(device, cache_folder());
  return run_on(options, vulkan_stress_backend(device));
}

}  // namespace trisect
