#include "app/cli/accuracy_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/buffers/kernel_choice.h"
#include "app/cli/json_text.h"
#include "app/mesh/obj_file.h"

namespace trisect {

std::string accuracy_table_header() {
  return "| model | surface | shell | solver | hit | undecidable | wrong hit | missed | wrong "
         "patch | "
         "off p50 | "
         "off p99 | off max | ulp p50 | ulp p99 | normal p99 | evals | cpu differs | ms | |\n"
         "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

std::string accuracy_table_row(const AccuracyRow& row) {
  const Accuracy& a = row.accuracy;
  return fmt::format(
      "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.1e} | {:.1e} | {:.1e} | {:.2g} | {:.2g} | "
      "{:.4f} | "
      "{:.1f} | {} | {:.0f} | {} |\n",
      model_name(row.model), surface_name(row.choice.surface), shell_name(row.choice.shell),
      solver_name(row.solver), a.hits, a.undecidable, a.wrong_hits, a.missed, a.wrong_patches,
      a.off_surface.p50, a.off_surface.p99, a.off_surface.max, a.depth_ulp.p50, a.depth_ulp.p99,
      a.normal_degrees.p99, a.median_evaluations, row.cpu_differs, row.gpu_ms, row.verdict);
}

nlohmann::ordered_json json_of(const AccuracyRow& row) {
  const Accuracy& a = row.accuracy;
  nlohmann::ordered_json json;
  json["model"] = row.model;
  json["surface"] = surface_name(row.choice.surface);
  json["shell"] = shell_name(row.choice.shell);
  json["solver"] = solver_name(row.solver);
  json["pixels"] = a.pixels;
  json["hits"] = a.hits;
  json["undecidable"] = a.undecidable;
  json["wrong_hits"] = a.wrong_hits;
  json["missed"] = a.missed;
  json["wrong_patches"] = a.wrong_patches;
  json["nans"] = a.nans;
  json["off_surface"] = json_of(a.off_surface);
  json["depth_ulp"] = json_of(a.depth_ulp);
  json["normal_degrees"] = json_of(a.normal_degrees);
  json["evals_per_candidate"] = a.median_evaluations;
  json["cpu_differs"] = row.cpu_differs;
  json["gpu_ms"] = row.gpu_ms;
  json["verdict"] = row.verdict;
  return json;
}

}  // namespace trisect
