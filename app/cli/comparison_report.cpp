#include "app/cli/comparison_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/cli/json_text.h"
#include "app/crosscheck/comparison_picture.h"
#include "app/crosscheck/frame_comparison.h"

namespace trisect {
namespace {

nlohmann::ordered_json to_json(const FrameComparison& c) {
  nlohmann::ordered_json json{
      {"pixels", c.pixels}, {"hits", c.hits}, {"hit_mismatches", c.hit_mismatches}};
  if (c.depth) {
    json["patch_mismatches"] = c.depth->patch_mismatches;
    json["z_pixels"] = c.depth->pixels;
    json["z_bit_equal"] = c.depth->bit_equal;
    json["z_apart"] = json_of(c.depth->z_apart);
    json["z_ulp"] = json_of(c.depth->ulp);
    json["normal_degrees"] = json_of(c.depth->normal_degrees);
  }
  json["color_rmse"] = c.color_rmse;
  json["color_max"] = c.color_max;
  json["alpha_max"] = c.alpha_max;
  json["nan_pixels"] = c.nan_pixels;
  // Infinite if no colour differs; JSON has no infinity, so null is written.
  json["psnr"] = c.psnr;
  return json;
}

}  // namespace

nlohmann::ordered_json report_pair(const std::string& name_a, const Frame& a,
                                   const std::string& name_b, const Frame& b,
                                   const Tolerance& tolerance) {
  const FrameComparison comparison = compare(a, b);
  say("{} | {}\n{}", name_a, name_b, to_text(comparison));
  nlohmann::ordered_json json{{"a", name_a}, {"b", name_b}};
  json.update(to_json(comparison));
  json["excesses"] = nlohmann::ordered_json::array();
  for (const std::string& excess : excesses(comparison, tolerance)) add_excess(excess, json);
  return json;
}

void add_excess(const std::string& excess, nlohmann::ordered_json& figures) {
  say("  too far apart: {}\n", excess);
  figures["excesses"].push_back(excess);
}

ComparisonFiles::ComparisonFiles(const std::string& json, const std::string& diff) : json_(json) {
  if (!diff.empty()) format_ = output_format(diff);
  if (!diff.empty()) diff_.emplace(diff);
  name_ = diff;
}

void ComparisonFiles::write(const nlohmann::ordered_json& json, const Frame& a, const Frame& b) {
  json_.write(json_text(json));
  if (diff_) {
    write_image(comparison_picture(a, b), *format_, diff_->file());
    diff_->commit();
    say("{}: the scale of the difference ends at {}\n", name_, comparison_scale(a, b));
  }
  json_.commit();
}

}  // namespace trisect
