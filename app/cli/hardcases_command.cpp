#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/base/error.h"
#include "app/cli/cache_folder.h"
#include "app/cli/commands.h"
#include "app/cli/hardcases_report.h"
#include "app/cli/interrupt.h"
#include "app/cli/json_text.h"
#include "app/cli/output.h"
#include "app/dispatch/pipeline_store.h"
#include "app/stress/stress_backend.h"
#include "app/stress/stress_judge.h"

namespace trisect {
namespace {

std::string to_json(const StressBackend& backend, const std::vector<StressRow>& rows) {
  nlohmann::ordered_json json;
  json["program"] = "trisect";
  json["version"] = TRISECT_VERSION;
  json["device"] = backend.device;
  json["driver"] = backend.driver;
  json["rows"] = hardcases_columns().json(rows);
  return json_text(json);
}

std::vector<StressRow> run_all(const StressBackend& backend) {
  std::vector<StressRow> rows;
  const auto add = [&](StressRow row) {
    say("{}", hardcases_columns().text_row(row));
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
  begin_outputs({}, {options.json});
  OptionalOutput json(options.json);
  say("device {}, driver {}\n", backend.device, backend.driver);
  say("{}", hardcases_columns().text_header());
  const std::vector<StressRow> rows = run_all(backend);
  const BindingRows binding = count_binding(rows);
  say("ulp: depth error across the surface, |dz| |n.v|, in units of 2^-23 of the scene's radius "
      "(of the eye's distance in images)\n"
      "{} of {} rows of the robust solver in the normal shell pass, {} undecided\n",
      binding.passed, binding.all, binding.undecided);
  json.write(to_json(backend, rows));
  json.commit();
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
