#include "app/comparison_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "app/frame_comparison.h"
#include "app/json_text.h"

namespace trisect {

nlohmann::ordered_json report_pair(const std::string& name_a, const Frame& a,
                                   const std::string& name_b, const Frame& b,
                                   const Tolerance& tolerance) {
  const FrameComparison comparison = compare(a, b);
  const std::vector<std::string> found = excesses(comparison, tolerance);
  fmt::print("{} | {}\n{}", name_a, name_b, to_text(comparison));
  for (const std::string& excess : found) fmt::print("  too far apart: {}\n", excess);
  nlohmann::ordered_json json{{"a", name_a}, {"b", name_b}};
  json.update(to_json(comparison));
  json["excesses"] = found;
  return json;
}

ComparisonFiles::ComparisonFiles(const std::string& json, const std::string& diff) {
  if (!diff.empty()) format_ = image_format(diff);
  if (!json.empty()) json_.emplace(json);
  if (!diff.empty()) diff_.emplace(diff);
}

void ComparisonFiles::write(const nlohmann::ordered_json& json, const Frame& a, const Frame& b) {
  if (json_) json_->write(json_text(json));
  if (diff_) {
    write_image(comparison_picture(a, b), *format_, false, *diff_);
    diff_->commit();
  }
  if (json_) json_->commit();
}

}  // namespace trisect
