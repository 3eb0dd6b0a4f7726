#include "app/bench/pareto_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/bench/gnuplot.h"
#include "app/bench/pareto_front.h"
#include "app/report/columns.h"

namespace trisect::bench {
namespace {

using report::Columns;
using report::Value;

std::string label_of(const Measurement& one) {
  return one.number.empty() ? one.family : one.family + ", " + one.number;
}

bool is_thesis(const Measurement& one) {
  return one.family.starts_with("thesis");
}

bool is_robust(const Measurement& one) {
  return one.family.starts_with("robust");
}

bool is_embree(const Measurement& one) {
  return one.family.starts_with("Embree");
}

// The fastest of the measurements that `of` accepts; null if there is none.
template <typename Of>
const Measurement* fastest(const Scene& scene, Of&& of) {
  const Measurement* best = nullptr;
  for (const Measurement& one : scene.measurements) {
    if (of(one) && (best == nullptr || one.ms.median < best->ms.median)) best = &one;
  }
  return best;
}

struct ParetoRow {
  const Scene& scene;
  const Measurement& one;
};

std::vector<ParetoRow> rows_of(const Scene& scene) {
  std::vector<ParetoRow> rows;
  for (const Measurement& one : scene.measurements) rows.push_back({scene, one});
  return rows;
}

Value dominating_label(const ParetoRow& row) {
  if (!row.one.dominated_by) return {};
  return label_of(row.scene.measurements[*row.one.dominated_by]);
}

Value null_if_0(uint64_t count) {
  return count > 0 ? Value(count) : Value();
}

// A column stands twice where the outputs have it in different places or show different values.
const Columns<ParetoRow>& pareto_columns() {
  // clang-format off
  static const Columns<ParetoRow> columns{
      {{"model", "{}"}, "", {}, [](auto& r) { return r.scene.model; }},
      {{"surface", "{}"}, "", {}, [](auto& r) { return surface_name(r.scene.surface); }},
      {{"patches", "{}"}, "", {}, [](auto& r) { return r.scene.patches; }},
      {{"family", "\"{}\""}, "family", {}, [](auto& r) { return r.one.family; }},
      {{"number", "\"{}\""}, "number", {}, [](auto& r) { return r.one.number; }},
      {{}, "", {"contender", "{}"}, [](auto& r) { return label_of(r.one); }},
      {{}, "ms.min", {}, [](auto& r) { return r.one.ms.min; }},
      {{"ms_median", "{:.3f}"}, "ms.median", {"ms", "{:.1f}"}, [](auto& r) { return r.one.ms.median; }},
      {{"ms_min", "{:.3f}"}, "", {"least", "{:.1f}"}, [](auto& r) { return r.one.ms.min; }},
      {{"ms_max", "{:.3f}"}, "ms.max", {"most", "{:.1f}"}, [](auto& r) { return r.one.ms.max; }},
      {{"rms", "{:.4e}"}, "rms", {"error", "{:.1e}"}, [](auto& r) { return r.one.errors.rms; }},
      {{}, "", {"wrong", "{}"}, [](auto& r) { return r.one.errors.wrong; }},
      {{}, "", {"missed", "{}"}, [](auto& r) { return r.one.errors.missed; }},
      {{"off_p50", "{:.4e}"}, "off_surface.p50", {"off p50", "{:.1e}"}, [](auto& r) { return r.one.errors.off.p50; }},
      {{"off_p99", "{:.4e}"}, "off_surface.p99", {"off p99", "{:.1e}"}, [](auto& r) { return r.one.errors.off.p99; }},
      {{"off_max", "{:.4e}"}, "off_surface.max", {"off max", "{:.1e}"}, [](auto& r) { return r.one.errors.off.max; }},
      {{"ulp_p50", "{:.3g}"}, "depth_ulp.p50", {}, [](auto& r) { return r.one.errors.depth_ulp.p50; }},
      {{"ulp_p99", "{:.3g}"}, "depth_ulp.p99", {"ulp p99", "{:.2g}"}, [](auto& r) { return r.one.errors.depth_ulp.p99; }},
      {{"ulp_max", "{:.3g}"}, "depth_ulp.max", {}, [](auto& r) { return r.one.errors.depth_ulp.max; }},
      {{"normal_p50", "{:.3e}"}, "normal_degrees.p50", {}, [](auto& r) { return r.one.errors.normal_degrees.p50; }},
      {{"normal_p99", "{:.3e}"}, "normal_degrees.p99", {"normal p99", "{:.2g}"},
       [](auto& r) { return r.one.errors.normal_degrees.p99; }},
      {{"normal_max", "{:.3e}"}, "normal_degrees.max", {}, [](auto& r) { return r.one.errors.normal_degrees.max; }},
      {{"wrong", "{}"}, "wrong_hits", {}, [](auto& r) { return r.one.errors.wrong; }},
      {{"missed", "{}"}, "missed", {}, [](auto& r) { return r.one.errors.missed; }},
      {{"undecidable", "{}"}, "undecidable", {}, [](auto& r) { return r.one.errors.undecidable; }},
      {{"nans", "{}"}, "nans", {}, [](auto& r) { return r.one.errors.nans; }},
      {{"outline_mean", "{:.4f}"}, "outline.mean", {"outline", "{:.2f}"}, [](auto& r) { return r.one.errors.outline.mean; }},
      {{"outline_max", "{:.3f}"}, "outline.max", {}, [](auto& r) { return r.one.errors.outline.max; }},
      {{"color_rmse", "{:.5g}"}, "color_rmse", {"RMSE", "{:.2g}"}, [](auto& r) { return r.one.errors.color_rmse; }},
      {{"psnr", "{:.4g}"}, "", {"PSNR", "{:.0f}"}, [](auto& r) { return r.one.errors.psnr; }},
      // Infinite if no colour differs, which JSON cannot say.
      {{}, "psnr", {}, [](auto& r) { return std::isfinite(r.one.errors.psnr) ? Value(r.one.errors.psnr) : Value(); }},
      {{"evaluations", "{}"}, "evaluations", {}, [](auto& r) { return r.one.work.evaluations; }},
      {{"candidates", "{}"}, "candidates", {}, [](auto& r) { return r.one.work.candidates; }},
      {{"bytes_read", "{}"}, "bytes_read", {}, [](auto& r) { return r.one.work.bytes_read; }},
      {{"bytes", "{}"}, "bytes", {}, [](auto& r) { return r.one.bytes; }},
      // A contender that does not count its work has 0.
      {{}, "", {"evaluations", "{}"}, [](auto& r) { return null_if_0(r.one.work.evaluations); }},
      {{}, "", {"MB read", "{}"},
       [](auto& r) { return r.one.work.bytes_read > 0 ? Value(r.one.work.bytes_read >> 20U) : Value(); }},
      {{}, "", {"KB", "{}"}, [](auto& r) { return r.one.bytes / 1024; }},
      {{}, "on_front", {}, [](auto& r) { return !r.one.dominated_by.has_value(); }},
      {{}, "", {"front", "{}"}, [](auto& r) { return r.one.dominated_by ? "" : "yes"; }},
      {{"dominated_by", "\"{}\""}, "dominated_by", {}, dominating_label},
  };
  // clang-format on
  return columns;
}

std::string joined(const std::vector<std::string>& texts) {
  return fmt::format("{}", fmt::join(texts, "; "));
}

// A contender in the panels of time over error.
struct PlotPoint {
  double p99;  // off the surface, and the largest; NaN if it hits nothing that is to be hit
  double max;
  double time;
  double wrong;  // pixels
};

// time_of(scene): what time is divided by.
template <typename TimeOf>
std::vector<PlotPoint> points_of(const Scene& scene, TimeOf&& time_of) {
  std::vector<PlotPoint> points;
  for (const Measurement& one : scene.measurements) {
    const auto wrong = static_cast<double>(wrong_pixels(one));
    const bool hits = std::max(one.errors.off.p99, one.errors.off.max) > 0.0 || wrong == 0.0;
    // No distance, and no wrong pixel, have a place on a logarithmic axis too.
    const auto on_axis = [&](double distance) {
      return hits ? std::max(distance, 1e-9) : std::numeric_limits<double>::quiet_NaN();
    };
    points.push_back({on_axis(one.errors.off.p99), on_axis(one.errors.off.max),
                      one.ms.median / time_of(scene), std::max(wrong, 0.5)});
  }
  return points;
}

// The points before which there is no other, as lines of error and time.
std::string front_of(const std::vector<PlotPoint>& points, double PlotPoint::*error) {
  std::vector<Point> all;
  all.reserve(points.size());
  for (const PlotPoint& point : points) all.push_back({point.*error, point.time});
  const std::vector<std::optional<std::size_t>> by = dominating(all);
  std::string lines;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!by[i]) lines += fmt::format("{} {}\n", all[i].error, all[i].ms);
  }
  return lines;
}

// Time over distance off the surface, and time over wrong pixels; a contender's curve breaks off
// between scenes. time: what the vertical axis has. time_of: as above.
template <typename TimeOf>
std::string panels(const std::vector<const Scene*>& scenes, const std::string& title,
                   const std::string& time, TimeOf&& time_of, const std::string& terminal,
                   const std::string& file) {
  std::vector<std::string> all;
  for (const Scene* scene : scenes) {
    for (const Measurement& one : scene->measurements) all.push_back(one.family);
  }
  const std::vector<std::string> families = distinct(all);
  std::vector<std::string> curves(families.size());
  std::string near_front;
  std::string right_front;
  for (const Scene* scene : scenes) {
    const std::vector<PlotPoint> points = points_of(*scene, time_of);
    near_front += front_of(points, &PlotPoint::p99);
    right_front += front_of(points, &PlotPoint::wrong);
    for (std::size_t k = 0; k < families.size(); ++k) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (scene->measurements[i].family != families[k]) continue;
        const PlotPoint& point = points[i];
        curves[k] += fmt::format("{} {} {} {}\n", point.p99, point.max, point.time, point.wrong);
      }
      curves[k] += '\n';
    }
  }
  std::string script = two_panels(terminal, file, title);
  for (std::size_t k = 0; k < families.size(); ++k) {
    script += fmt::format("$family{} << EOD\n{}EOD\n", k, curves[k]);
  }
  script += fmt::format(
      "$near << EOD\n{}EOD\n$right << EOD\n{}EOD\n"
      "set format x \"10^{{%L}}\"\nset ylabel \"{}\"\n",
      near_front, right_front, time);
  const auto plot = [&](const char* columns, const char* style, const char* front) {
    std::string text = "plot ";
    for (std::size_t k = 0; k < families.size(); ++k) {
      text += fmt::format("$family{} using {} with {} {}, ", k, columns, style,
                          curve_style(families, k));
    }
    return text + fmt::format(
                      "${} using 1:2 with points pt 6 ps 2.5 lc rgb \"black\" title \"Pareto "
                      "front\"\n",
                      front);
  };
  script += "set xlabel \"off the surface / radius: 99 of 100 hits, line to the largest\"\n" +
            plot("1:3:1:2", "xerrorlines", "near");
  script += "set xlabel \"wrong or missed pixels (none: drawn at 0.5)\"\nset format x \"%g\"\n" +
            plot("4:3", "linespoints", "right");
  return script + "unset multiplot\n";
}

}  // namespace

std::string name_of(const Scene& scene) {
  return scene.model + "-" + surface_name(scene.surface);
}

std::string csv_of(const std::vector<Scene>& scenes) {
  std::vector<ParetoRow> rows;
  for (const Scene& scene : scenes) {
    for (const ParetoRow& row : rows_of(scene)) rows.push_back(row);
  }
  return pareto_columns().csv(rows);
}

nlohmann::ordered_json json_of(const std::vector<Scene>& scenes) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Scene& scene : scenes) {
    all.push_back({{"model", scene.model},
                   {"surface", surface_name(scene.surface)},
                   {"patches", scene.patches},
                   {"measurements", pareto_columns().json(rows_of(scene))}});
  }
  return all;
}

std::vector<std::string> findings_of(const Scene& scene) {
  std::vector<std::string> findings;
  const Measurement* robust = fastest(scene, is_robust);
  if (robust == nullptr) return findings;
  findings.push_back(fmt::format(
      "{}: {:.1f} ms at an error of {:.1e}, {} wrong or missed pixels; it is {} the Pareto front.",
      label_of(*robust), robust->ms.median, robust->errors.rms, wrong_pixels(*robust),
      robust->dominated_by
          ? "not on (" + label_of(scene.measurements[*robust->dominated_by]) + " is before it)"
          : "on"));
  std::vector<std::string> faster;
  for (const Measurement& one : scene.measurements) {
    if (is_thesis(one) && one.ms.median < robust->ms.median) faster.push_back(label_of(one));
  }
  findings.push_back(faster.empty() ? "No Rank of the thesis is faster, at any error."
                                    : "Faster, with larger errors, are " + joined(faster) + ".");
  const Measurement* thesis = fastest(
      scene, [](const Measurement& one) { return is_thesis(one) && one.number == "Rank 10"; });
  if (thesis != nullptr) {
    findings.push_back(fmt::format(
        "The thesis at Rank 10 takes {:.1f} times as long and has {} wrong or missed pixels.",
        thesis->ms.median / robust->ms.median, wrong_pixels(*thesis)));
  }
  // Missed pixels do not count: the outline of flat triangles misses some, however fine they are.
  const Measurement* fine = fastest(
      scene, [](const Measurement& one) { return is_embree(one) && one.errors.off.p99 <= 1e-5; });
  if (fine != nullptr) {
    findings.push_back(fmt::format(
        "Of Embree's, {} is the fastest that is off by at most 1e-5 at 99 of 100 pixels that it "
        "hits "
        "({:.1e}; {} wrong or missed): {:.1f} ms, {:.2f} times as long as {}, with {} times the "
        "memory.",
        label_of(*fine), fine->errors.off.p99, wrong_pixels(*fine), fine->ms.median,
        fine->ms.median / robust->ms.median, label_of(*robust),
        fine->bytes / std::max<std::size_t>(robust->bytes, 1)));
  } else {
    findings.emplace_back("None of Embree's is off by 1e-5 or less at 99 of 100 pixels.");
  }
  std::vector<std::string> coarse;
  for (const Measurement& one : scene.measurements) {
    if (one.dominated_by || is_robust(one) || one.ms.median >= robust->ms.median) continue;
    coarse.push_back(fmt::format("{}: {:.1f} times as fast at {:.1e}", label_of(one),
                                 robust->ms.median / one.ms.median, one.errors.rms));
  }
  if (!coarse.empty()) {
    findings.push_back("On the front before it, at larger errors: " + joined(coarse) + ".");
  }
  return findings;
}

report::Table table_of(const Scene& scene) {
  return pareto_columns().table(rows_of(scene));
}

std::string plot_script(const Scene& scene, const std::string& terminal, const std::string& file) {
  return panels(
      {&scene},
      fmt::format("{}, {} patches, {}", scene.model, scene.patches, surface_name(scene.surface)),
      "milliseconds a frame", [](const Scene&) { return 1.0; }, terminal, file);
}

std::string summary_script(const std::vector<Scene>& scenes, uint surface,
                           const std::string& terminal, const std::string& file) {
  std::vector<const Scene*> shown;
  std::vector<std::string> models;
  for (const Scene& scene : scenes) {
    if (scene.surface != surface || fastest(scene, is_robust) == nullptr) continue;
    shown.push_back(&scene);
    models.push_back(scene.model);
  }
  return panels(
      shown, fmt::format("{}: {}", surface_name(surface), fmt::join(models, ", ")),
      "times the robust solver's milliseconds",
      [](const Scene& scene) { return fastest(scene, is_robust)->ms.median; }, terminal, file);
}

}  // namespace trisect::bench
