#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "app/base/error.h"
#include "app/base/message.h"
#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/json_text.h"
#include "app/cli/model_facts.h"
#include "app/cli/named.h"
#include "app/cli/output.h"
#include "app/cli/progress_line.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"

namespace trisect {
namespace {

using nlohmann::ordered_json;

// How many meshes are printed; JSON has all.
constexpr std::size_t kPrintedMeshes = 12;

struct Model {
  ModelFormat format = ModelFormat::obj;
  std::size_t file_bytes = 0;
  PolygonModel polygons;
  BuiltMesh built;
  ModelFacts facts;
};

Model examine(const InfoOptions& options) {
  const BusyLine line("examining " + options.model);
  Model model;
  model.polygons = read_model(options.model, &model.format);
  std::error_code unused;
  model.file_bytes = std::filesystem::file_size(options.model, unused);
  stop_if_interrupted();
  model.built = build_mesh(model.polygons, options.model, options.mesh);
  model.facts = named(options.model, [&] { return facts_of(model.built.mesh, options.surface); });
  return model;
}

const char* source_name(NormalSource source) {
  switch (source) {
    case NormalSource::welded:
      return "made";
    case NormalSource::mixed:
      return "mixed";
    default:
      return "file";
  }
}

// Polygons of each mesh of the file, by its name.
std::vector<std::pair<std::string, std::size_t>> meshes_of(const PolygonModel& model) {
  std::vector<std::pair<std::string, std::size_t>> meshes;
  const std::vector<PolygonGroup>& groups = model.groups;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::size_t end = i + 1 < groups.size() ? groups[i + 1].first : model.sizes.size();
    meshes.emplace_back(groups[i].name, end - groups[i].first);
  }
  return meshes;
}

// Whether positions or normals are rounded more coarsely than floats.
bool is_quantised(const Model& model) {
  return model.polygons.position_rounding > 0.0 || model.polygons.normal_rounding > 0.0;
}

// How far the phong surface is moved, if that can be told: made normals depend on all positions
// around.
std::optional<double> moved_by_quantisation(const Model& model) {
  const PolygonModel& polygons = model.polygons;
  const double moved = moved_by_rounding(model.built.mesh, SurfaceChoice{}.alpha,
                                         polygons.position_rounding, polygons.normal_rounding);
  const bool is_known = std::isfinite(moved) && model.built.report.normals == NormalSource::file;
  return is_known ? std::optional(moved) : std::nullopt;
}

// The angle between unit vectors, in degrees.
double degrees_between(double difference) {
  return glm::degrees(2.0 * std::asin(std::min(0.5 * difference, 1.0)));
}

ordered_json quantisation_of(const Model& model) {
  if (!is_quantised(model)) return nullptr;
  const PolygonModel& polygons = model.polygons;
  const auto known = [](double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json();
  };
  const std::optional<double> moved = moved_by_quantisation(model);
  return {{"positions", known(polygons.position_rounding)},
          {"normals_degrees", std::isfinite(polygons.normal_rounding)
                                  ? ordered_json(degrees_between(polygons.normal_rounding))
                                  : ordered_json()},
          {"phong_moved", moved ? ordered_json(*moved) : ordered_json()}};
}

std::string quantisation_text(const Model& model) {
  const PolygonModel& polygons = model.polygons;
  if (!std::isfinite(polygons.position_rounding + polygons.normal_rounding)) {
    return "by a compression whose rounding is not read";
  }
  std::string text =
      fmt::format("positions are off by up to {:.2g}, normals by {:.2g} degrees",
                  polygons.position_rounding, degrees_between(polygons.normal_rounding));
  if (const std::optional<double> moved = moved_by_quantisation(model)) {
    text += fmt::format("; phong moves by at most {:.2g}, {:.2g} of the radius", *moved,
                        *moved / model.facts.radius);
  }
  return text;
}

// What to do about what was found.
std::vector<std::string> advice_of(const Model& model) {
  const MeshReport& report = model.built.report;
  const ModelFacts& facts = model.facts;
  std::vector<std::string> advice;
  const auto add = [&](std::size_t count, const char* text) {
    if (count > 0) advice.push_back(fmt::format("{} {}", count, text));
  };
  add(report.open_edges,
      "open edges: borders, or vertices that do not quite meet; --weld EPS takes those for one");
  add(report.flipped_edges,
      "edges between triangles of opposite winding; --repair turns triangles around");
  add(report.non_manifold_edges,
      "edges of three triangles or more: the normals that are made are not smooth across them");
  add(report.hard_edges,
      "hard edges: curved triangles part there; --crease 180 makes one normal for each vertex");
  add(report.normals_behind,
      "corner normals point behind their face: wrong normals (--crease 180 makes others) or "
      "winding");
  add(facts.leaning > report.normals_behind ? facts.leaning : 0,
      "corners lean by more than 60 degrees: surfaces bulge there; more triangles would help");
  add(facts.surface.folding, "patches fold over: rays meet them several times");
  add(facts.without_height_shell,
      "triangles have no surface in the height shell; the normal shell has one for all");
  return advice;
}

ordered_json json_of(const InfoOptions& options, const Model& model) {
  const MeshReport& report = model.built.report;
  const ModelFacts& facts = model.facts;
  const auto triple = [](const glm::dvec3& v) { return ordered_json{v.x, v.y, v.z}; };
  ordered_json json{{"program", "trisect"},
                    {"version", TRISECT_VERSION},
                    {"model", options.model},
                    {"format", format_name(model.format)},
                    {"file_bytes", model.file_bytes},
                    {"meshes", ordered_json::array()},
                    {"polygons", model.polygons.sizes.size()},
                    {"triangles", report.triangles},
                    {"vertices", report.vertices},
                    {"degenerate_dropped", report.degenerate_dropped},
                    {"colored", report.colored},
                    {"notes", report.notes},
                    {"bounds", {{"low", triple(facts.low)}, {"high", triple(facts.high)}}},
                    {"radius", facts.radius},
                    {"normals",
                     {{"source", source_name(report.normals)},
                      {"largest_lean", facts.largest_lean},
                      {"lean_beyond_60", facts.leaning},
                      {"behind", report.normals_behind}}},
                    {"edges",
                     {{"open", report.open_edges},
                      {"hard", report.hard_edges},
                      {"non_manifold", report.non_manifold_edges},
                      {"opposite_winding", report.flipped_edges}}},
                    {"turned", report.turned}};
  json["quantisation"] = quantisation_of(model);
  for (const auto& [name, polygons] : meshes_of(model.polygons)) {
    json["meshes"].push_back({{"name", name}, {"polygons", polygons}});
  }
  const SurfaceFacts& surface = facts.surface;
  json["surface"] = {{"surface", surface_name(surface.choice.surface)},
                     {"shell", shell_name(surface.choice.shell)},
                     {"parts", surface.parts},
                     {"device_bytes", surface.device_bytes},
                     {"folding", surface.folding},
                     {"largest_displacement", surface.largest_displacement}};
  json["height_shell"] = {{"without_surface", facts.without_height_shell},
                          {"largest_crack", facts.largest_crack}};
  json["advice"] = advice_of(model);
  return json;
}

void print(const InfoOptions& options, const Model& model) {
  const MeshReport& report = model.built.report;
  const ModelFacts& facts = model.facts;
  const auto row = [](const char* what, const std::string& text) { say("{:<13}{}\n", what, text); };
  const auto megabytes = [](std::size_t bytes) {
    return fmt::format("{:.3g} MB", static_cast<double>(bytes) / 1e6);
  };
  row("file", fmt::format("{}, {}, {}", escaped(options.model), format_name(model.format),
                          megabytes(model.file_bytes)));
  const auto meshes = meshes_of(model.polygons);
  for (std::size_t i = 0; i < std::min(meshes.size(), kPrintedMeshes); ++i) {
    row(i == 0 ? "meshes" : "",
        fmt::format("\"{}\", {} polygons", escaped(meshes[i].first), meshes[i].second));
  }
  if (meshes.size() > kPrintedMeshes) {
    row("", fmt::format("and {} more", meshes.size() - kPrintedMeshes));
  }
  row("polygons", fmt::format("{}: {} triangles, {} without area dropped, {} vertices",
                              model.polygons.sizes.size(), report.triangles,
                              report.degenerate_dropped, report.vertices));
  for (const std::string& note : report.notes) row("", escaped(note));
  if (report.turned > 0) row("", fmt::format("{} triangles turned around", report.turned));
  row("bounds", fmt::format("{:.6g},{:.6g},{:.6g} to {:.6g},{:.6g},{:.6g}; radius {:.6g}",
                            facts.low.x, facts.low.y, facts.low.z, facts.high.x, facts.high.y,
                            facts.high.z, facts.radius));
  if (is_quantised(model)) row("quantised", quantisation_text(model));
  const char* normals = report.normals == NormalSource::file ? "from the file"
                        : report.normals == NormalSource::welded
                            ? "made"
                            : "from the file where it has them";
  row("normals",
      fmt::format("{}; they lean by up to {:.1f} degrees, {} by more than {:.0f}, {} "
                  "point behind their face",
                  normals, facts.largest_lean, facts.leaning, kSteepLean, report.normals_behind));
  row("edges",
      fmt::format("{} open, {} hard, {} non-manifold, {} of opposite winding", report.open_edges,
                  report.hard_edges, report.non_manifold_edges, report.flipped_edges));
  const SurfaceFacts& surface = facts.surface;
  row(surface_name(surface.choice.surface),
      fmt::format("{} parts, {}; displaced by up to {:.3g} of the radius; {} patches fold",
                  surface.parts, megabytes(surface.device_bytes), surface.largest_displacement,
                  surface.folding));
  row("height shell",
      fmt::format("phong parts along edges by up to {:.3g} of the radius; {} triangles have no "
                  "surface",
                  facts.largest_crack, facts.without_height_shell));
  const std::vector<std::string> advice = advice_of(model);
  for (std::size_t i = 0; i < advice.size(); ++i) row(i == 0 ? "look at" : "", advice[i]);
}

}  // namespace

int info(const InfoOptions& options) {
  begin_outputs({options.model}, {options.json});
  OptionalOutput file(options.json);
  const Model model = examine(options);
  print(options, model);
  if (file.is_wanted()) file.write(json_text(json_of(options, model)));
  file.commit();
  return exit_done;
}

}  // namespace trisect
