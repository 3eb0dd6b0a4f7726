#include "app/bench/speed_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/mesh/obj_file.h"
#include "app/surface/surface_choice.h"

namespace trisect::bench {

std::string speed_table_header() {
  return "| model | surface | contender | ms | least | most | of the thesis | of the image | wrong "
         "| of | KB | build ms |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

std::string speed_table_row(const SpeedRow& row) {
  return fmt::format(
      "| {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.3f} | {:.1f} | {} | {} | {} | {} |\n",
      model_name(row.model), surface_name(row.surface), row.contender, row.ms.median, row.ms.min,
      row.ms.max, row.ms.median / row.thesis_ms, row.ms.median / row.floor_ms,
      row.wrong_pixels ? fmt::to_string(*row.wrong_pixels) : "",
      row.checked_pixels ? fmt::to_string(*row.checked_pixels) : "", row.bytes / 1024,
      row.build_ms ? fmt::format("{:.0f}", *row.build_ms) : "");
}

nlohmann::ordered_json json_of(const SpeedRow& row) {
  nlohmann::ordered_json one;
  one["model"] = row.model;
  one["surface"] = surface_name(row.surface);
  one["patches"] = row.patches;
  one["contender"] = row.contender;
  one["ms"] = json_of(row.ms);
  if (row.checked_pixels) one["checked_pixels"] = *row.checked_pixels;
  if (row.wrong_pixels) one["wrong_pixels"] = *row.wrong_pixels;
  one["bytes"] = row.bytes;
  if (row.build_ms) one["build_ms"] = *row.build_ms;
  if (row.flat_triangles) one["flat_triangles"] = *row.flat_triangles;
  if (row.flat_error) one["flat_error"] = *row.flat_error;
  return one;
}

}  // namespace trisect::bench
