#include "app/cli/floats_report.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

namespace trisect {
namespace {

std::string text_of(const LargestError& largest) {
  return std::isfinite(largest.ulp) ? fmt::format("{:.3g} ulp", largest.ulp) : "NaN or infinite";
}

std::string text_of(const Share& share) {
  if (share.yes == share.of) return "yes";
  return share.yes == 0 ? "no" : fmt::format("{} of {}", share.yes, share.of);
}

nlohmann::ordered_json json_of(const LargestError& largest) {
  nlohmann::ordered_json json{{"items", largest.items}};
  // JSON has no infinity.
  if (std::isfinite(largest.ulp)) {
    json["ulp"] = largest.ulp;
  } else {
    json["ulp"] = nullptr;
  }
  json["at"] = {std::bit_cast<float>(largest.at.a), std::bit_cast<float>(largest.at.b),
                std::bit_cast<float>(largest.at.c)};
  return json;
}

nlohmann::ordered_json json_of(const Share& share) {
  return {{"yes", share.yes}, {"of", share.of}};
}

}  // namespace

std::vector<FloatRow> float_rows(const FloatReport& report) {
  const char* const rounding = "bounds of rounding errors";
  const char* const same = "equal bits from all kernels";
  const char* const no = "nothing";
  const char* const declared = "if declared";
  // Two roundings have no bound in ulp of the result.
  const std::string fused = report.fma_fused.yes == report.fma_fused.of
                                ? "yes, " + text_of(report.fma)
                                : text_of(report.fma_fused);
  std::vector<FloatRow> rows{
      {"a + b", text_of(report.add), "1 ulp, rounded up or down", rounding},
      {"a - b", text_of(report.subtract), "1 ulp, rounded up or down", rounding},
      {"a * b", text_of(report.multiply), "1 ulp, rounded up or down", rounding},
      {"rounded to nearest, ties to even", text_of(report.nearest_even), declared, rounding},
      {"a / b", text_of(report.divide), "2.5 ulp, b within 2^-126 to 2^126", rounding},
      {"the same quotient everywhere", text_of(report.division_repeats), "no", same},
      {"sqrt(a)", text_of(report.sqrt), "as 1 / inversesqrt(a)", rounding},
      {"inversesqrt(a)", text_of(report.inversesqrt), "2 ulp", no},
      {"fma(a, b, c) has one rounding", fused, "either", no},
      {"a * b + c contracted", text_of(report.plain_contracted), "either", no},
      {"the same with NoContraction", text_of(report.precise_contracted), "no", same},
      {"denormal operands kept", text_of(report.denormal_operands), declared, no},
      {"denormal results kept", text_of(report.denormal_results), declared, no},
      {"denormals kept by load and store", text_of(report.denormal_copies), declared, no}};
  if (report.denormal_broadcast) {
    rows.push_back(
        {"denormals kept by subgroupBroadcast", text_of(*report.denormal_broadcast), declared, no});
  }
  const std::vector<FloatRow> special{
      {"comparisons with NaN", text_of(report.nan_tests), declared, "guards end at NaN"},
      {"NaN from + - *", text_of(report.nan_results), declared, "guards end at NaN"},
      {"min, max drop NaN", text_of(report.nan_lost_by_min_max), "either operand", no},
      {"infinity from + - *", text_of(report.infinities), declared, no},
      {"a / 0 infinite", text_of(report.division_by_zero), "no", no},
      {"sign of 0 from + - *", text_of(report.signed_zeros), declared, no},
      {"a - a, a * 0, a + 0 not folded", text_of(report.not_folded), declared, no},
      {"bits of uint to float to uint", text_of(report.bits), "kept", "words of the scene"}};
  rows.insert(rows.end(), special.begin(), special.end());
  return rows;
}

const report::Columns<FloatRow>& float_columns() {
  static const report::Columns<FloatRow> columns{
      {{}, "operation", {"operation", "{}"}, [](auto& r) { return r.operation; }},
      {{}, "measured", {"measured", "{}"}, [](auto& r) { return r.measured; }},
      {{}, "promised", {"Vulkan promises", "{}"}, [](auto& r) { return r.promised; }},
      {{}, "relied_on", {"relied on for", "{}"}, [](auto& r) { return r.relied; }},
  };
  return columns;
}

nlohmann::ordered_json float_figures(const FloatReport& report) {
  nlohmann::ordered_json json{{"items", report.items},
                              {"add", json_of(report.add)},
                              {"subtract", json_of(report.subtract)},
                              {"multiply", json_of(report.multiply)},
                              {"divide", json_of(report.divide)},
                              {"sqrt", json_of(report.sqrt)},
                              {"inversesqrt", json_of(report.inversesqrt)},
                              {"fma", json_of(report.fma)},
                              {"nearest_even", json_of(report.nearest_even)},
                              {"fma_fused", json_of(report.fma_fused)},
                              {"precise_contracted", json_of(report.precise_contracted)},
                              {"plain_contracted", json_of(report.plain_contracted)},
                              {"division_repeats", json_of(report.division_repeats)},
                              {"denormal_operands", json_of(report.denormal_operands)},
                              {"denormal_results", json_of(report.denormal_results)},
                              {"denormal_copies", json_of(report.denormal_copies)}};
  if (report.denormal_broadcast) {
    json["denormal_broadcast"] = json_of(*report.denormal_broadcast);
  }
  json["nan_tests"] = json_of(report.nan_tests);
  json["nan_results"] = json_of(report.nan_results);
  json["nan_lost_by_min_max"] = json_of(report.nan_lost_by_min_max);
  json["infinities"] = json_of(report.infinities);
  json["division_by_zero"] = json_of(report.division_by_zero);
  json["signed_zeros"] = json_of(report.signed_zeros);
  json["not_folded"] = json_of(report.not_folded);
  json["bits"] = json_of(report.bits);
  return json;
}

}  // namespace trisect
