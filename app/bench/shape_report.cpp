#include "app/bench/shape_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/bench/gnuplot.h"
#include "app/report/columns.h"

namespace trisect::bench {
namespace {

using report::Columns;
using report::Value;

bool is_flat(const ShapeRow& row) {
  return row.choice.surface == SURFACE_FLAT;
}

const Columns<ShapeRow>& shape_columns() {
  // clang-format off
  static const Columns<ShapeRow> columns{
      {{"model", "{}"}, "model", {"model", "{}"}, [](auto& r) { return r.model; }},
      {{"triangles", "{}"}, "triangles", {"triangles", "{}"}, [](auto& r) { return r.triangles; }},
      {{"surface", "\"{}\""}, "surface", {"surface", "{}"}, [](auto& r) { return surface_text(r.choice); }},
      {{"off_surface", "{:.4e}"}, "off_surface", {"measured to", "{:.0e}"}, [](auto& r) { return r.off_surface; }},
      {{"rms", "{:.4e}"}, "distance.rms", {"RMS", "{:.1e}"}, [](auto& r) { return r.samples.rms; }},
      {{"p50", "{:.4e}"}, "distance.p50", {}, [](auto& r) { return r.samples.distance.p50; }},
      {{"p99", "{:.4e}"}, "distance.p99", {"p99", "{:.1e}"}, [](auto& r) { return r.samples.distance.p99; }},
      {{"to_shape_found", "{:.4e}"}, "to_shape.found", {"largest", "{:.2e}"}, [](auto& r) { return r.to_shape.found; }},
      {{"to_shape_bound", "{:.4e}"}, "to_shape.bound", {"at most", "{:.2e}"}, [](auto& r) { return r.to_shape.bound; }},
      {{"to_model_found", "{:.4e}"}, "to_model.found", {"back: largest", "{:.2e}"}, [](auto& r) { return r.to_model.found; }},
      {{"to_model_bound", "{:.4e}"}, "to_model.bound", {"at most", "{:.2e}"}, [](auto& r) { return r.to_model.bound; }},
      {{"shading_p50", "{:.3e}"}, "shading_degrees.p50", {}, [](auto& r) { return r.samples.shading_degrees.p50; }},
      {{"shading_p99", "{:.3e}"}, "shading_degrees.p99", {"shading normal p99", "{:.2g}"},
       [](auto& r) { return r.samples.shading_degrees.p99; }},
      {{"face_p50", "{:.3e}"}, "face_degrees.p50", {}, [](auto& r) { return r.samples.face_degrees.p50; }},
      {{"face_p99", "{:.3e}"}, "face_degrees.p99", {"normal p99", "{:.2g}"},
       [](auto& r) { return r.samples.face_degrees.p99; }},
      {{"wrong", "{}"}, "wrong_pixels", {}, [](auto& r) { return r.wrong; }},
      {{"outline_mean", "{:.4f}"}, "outline.mean", {}, [](auto& r) { return r.outline.mean; }},
      {{"outline_max", "{:.3f}"}, "outline.max", {}, [](auto& r) { return r.outline.max; }},
      {{"color_rmse", "{:.5g}"}, "color_rmse", {}, [](auto& r) { return r.color_rmse; }},
      {{"ssim", "{:.6f}"}, "ssim", {}, [](auto& r) { return r.similarity; }},
      {{"relmse", "{:.4e}"}, "relmse", {}, [](auto& r) { return r.relative; }},
      {{"accel", "{}"}, "accel", {}, [](auto& r) { return accel_name(r.accel); }},
      {{"ms_min", "{:.3f}"}, "ms.min", {}, [](auto& r) { return r.ms.min; }},
      {{"ms_median", "{:.3f}"}, "ms.median", {}, [](auto& r) { return r.ms.median; }},
      {{"ms_max", "{:.3f}"}, "ms.max", {}, [](auto& r) { return r.ms.max; }},
      {{"bytes", "{}"}, "bytes", {}, [](auto& r) { return r.bytes; }},
  };
  // clang-format on
  return columns;
}

const Columns<ShapeRow>& picture_columns() {
  // clang-format off
  static const Columns<ShapeRow> columns{
      {{}, "", {"model", "{}"}, [](auto& r) { return r.model; }},
      {{}, "", {"surface", "{}"}, [](auto& r) { return surface_text(r.choice); }},
      {{}, "", {"wrong pixels", "{}"}, [](auto& r) { return r.wrong; }},
      {{}, "", {"outline", "{:.2f}"}, [](auto& r) { return r.outline.mean; }},
      {{}, "", {"outline, most", "{:.1f}"}, [](auto& r) { return r.outline.max; }},
      {{}, "", {"RMSE", "{:.2g}"}, [](auto& r) { return r.color_rmse; }},
      {{}, "", {"relMSE", "{:.1e}"}, [](auto& r) { return r.relative; }},
      {{}, "", {"SSIM", "{:.4f}"}, [](auto& r) { return r.similarity; }},
      {{}, "", {"accel", "{}"}, [](auto& r) { return accel_name(r.accel); }},
      {{}, "", {"ms", "{:.1f}"}, [](auto& r) { return r.ms.median; }},
      {{}, "", {"KB", "{}"}, [](auto& r) { return r.bytes / 1024; }},
  };
  // clang-format on
  return columns;
}

// The RMS, or what can be told, if that is more.
double surely_off(const ShapeRow& row) {
  return std::max(row.samples.rms, row.off_surface);
}

std::string distance_text(const ShapeRow& row) {
  return row.samples.rms < row.off_surface ? fmt::format("less than {:.1e} off", row.off_surface)
                                           : fmt::format("{:.1e} off", row.samples.rms);
}

// The flat triangles of the fewest that are as near to the shape; null if none are.
const ShapeRow* flat_as_near(const Shape& shape, const ShapeRow& row) {
  const ShapeRow* least = nullptr;
  for (const ShapeRow& flat : shape.rows) {
    if (!is_flat(flat) || surely_off(flat) > surely_off(row)) continue;
    if (least == nullptr || flat.triangles < least->triangles) least = &flat;
  }
  return least;
}

const ShapeRow& finest_flat(const Shape& shape) {
  const ShapeRow* finest = nullptr;
  for (const ShapeRow& row : shape.rows) {
    if (is_flat(row) && (finest == nullptr || row.triangles > finest->triangles)) finest = &row;
  }
  return *finest;
}

std::string sentence_about(const Shape& shape, const ShapeRow& row, const ShapeRow& own_flat) {
  const std::string begin =
      fmt::format("{}, {} triangles: the nearest curved surface is {}, {} (RMS)", row.model,
                  row.triangles, surface_text(row.choice), distance_text(row));
  if (surely_off(row) >= surely_off(own_flat)) {
    return fmt::format("{}, no nearer than the flat triangles, {}.", begin,
                       distance_text(own_flat));
  }
  const ShapeRow* near = flat_as_near(shape, row);
  const ShapeRow& flat = near == nullptr ? finest_flat(shape) : *near;
  return fmt::format(
      "{}; {} flat triangles are {} ({}). It takes {:.2g} times their time and {:.2g} times their "
      "memory.",
      begin, flat.triangles, near == nullptr ? "the most measured, and not as near" : "as near",
      distance_text(flat), row.ms.median / flat.ms.median,
      static_cast<double>(row.bytes) / static_cast<double>(flat.bytes));
}

}  // namespace

std::string surface_text(const SurfaceChoice& choice) {
  return choice.surface == SURFACE_PHONG ? fmt::format("phong, alpha {}", choice.alpha)
                                         : surface_name(choice.surface);
}

std::string csv_of(const Shape& shape) {
  return shape_columns().csv(shape.rows);
}

nlohmann::ordered_json json_of(const Shape& shape) {
  nlohmann::ordered_json frames = nlohmann::ordered_json::array();
  for (const ShapeFrame& frame : shape.frames) {
    frames.push_back(
        {{"contender", frame.contender}, {"ms", json_of(frame.ms)}, {"bytes", frame.bytes}});
  }
  return {{"reference", shape.reference},
          {"triangles", shape.triangles},
          {"radius", shape.radius},
          {"models", shape_columns().json(shape.rows)},
          {"frames", frames}};
}

report::Table table_of(const Shape& shape) {
  return shape_columns().table(shape.rows);
}

report::Table pictures_table_of(const Shape& shape) {
  return picture_columns().table(shape.rows);
}

report::Table frames_table_of(const Shape& shape) {
  report::Table table{{{"drawn by", "ms", "KB"}}};
  for (const ShapeFrame& frame : shape.frames) {
    table.rows.push_back({frame.contender, fmt::format("{:.1f}", frame.ms.median),
                          fmt::format("{}", frame.bytes / 1024)});
  }
  return table;
}

std::vector<std::string> findings_of(const Shape& shape) {
  std::vector<std::string> findings;
  // Rows of a model follow each other, the flat one first.
  for (auto first = shape.rows.begin(); first != shape.rows.end();) {
    const auto end = std::find_if(first + 1, shape.rows.end(), is_flat);
    const auto nearest = std::min_element(
        first + 1, end, [](const auto& a, const auto& b) { return surely_off(a) < surely_off(b); });
    if (nearest != end) findings.push_back(sentence_about(shape, *nearest, *first));
    first = end;
  }
  return findings;
}

std::string plot_script(const Shape& shape, const std::string& terminal, const std::string& file) {
  std::vector<std::string> all;
  all.reserve(shape.rows.size());
  for (const ShapeRow& row : shape.rows) all.push_back(surface_text(row.choice));
  const std::vector<std::string> surfaces = distinct(all);
  std::string script =
      two_panels(terminal, file, fmt::format("{}, {} triangles", shape.reference, shape.triangles));
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    std::vector<const ShapeRow*> rows;
    for (const ShapeRow& row : shape.rows) {
      if (surface_text(row.choice) == surfaces[k]) rows.push_back(&row);
    }
    std::sort(rows.begin(), rows.end(),
              [](const ShapeRow* a, const ShapeRow* b) { return a->triangles < b->triangles; });
    script += fmt::format("$surface{} << EOD\n", k);
    for (const ShapeRow* row : rows) {
      script += fmt::format("{} {} {} {}\n", row->triangles, row->ms.median,
                            std::max(row->samples.rms, 1e-9), std::max(row->to_shape.found, 1e-9));
    }
    script += "EOD\n";
  }
  const auto curves = [&](int column) {
    std::vector<std::string> parts;
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
      parts.push_back(fmt::format("$surface{} using {}:3:3:4 with yerrorlines {}", k, column,
                                  curve_style(surfaces, k)));
    }
    return fmt::format("plot {}\n", fmt::join(parts, ", "));
  };
  return script +
         fmt::format(
             "set format y \"10^{{%L}}\"\n"
             "set ylabel \"off the shape / radius: RMS, line to the largest\"\n"
             "set xlabel \"triangles\"\n{}set xlabel \"milliseconds a frame\"\n{}unset multiplot\n",
             curves(1), curves(2));
}

}  // namespace trisect::bench
