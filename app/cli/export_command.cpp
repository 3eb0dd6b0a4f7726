#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>

#include "app/bake/bake.h"
#include "app/base/error.h"
#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/json_text.h"
#include "app/cli/named.h"
#include "app/cli/output.h"
#include "app/cli/progress_line.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "app/tessellation/flat_mesh.h"
#include "app/tessellation/flat_mesh_file.h"

namespace trisect {
namespace {

// What the file's numbers leave of the error that is asked for: with them added again it is no more
// than that.
double error_for_surface(const ExportOptions& options, double rounding) {
  if (*options.error > rounding) return (*options.error - rounding) * (1.0 - 1e-15);
  throw UsageError(fmt::format(
      "--error {:g}: the numbers in {} alone move vertices by up to {:.2g}: take a larger one{}.",
      *options.error, options.output, rounding,
      mesh_format_of(options.output) == MeshFormat::obj ? "" : ", or OBJ, which has more digits"));
}

FlatMesh flattened(const ExportOptions& options, const Mesh& mesh, const BakedScene& scene,
                   double rounding) {
  ProgressLine line("dividing " + options.model);
  const FractionProgress show = [&](double done) { return line.show(done); };
  FlatMesh flat = finished(
      options.subdivide ? divided_evenly(mesh, scene, *options.subdivide, show)
                        : divided_to(mesh, scene, error_for_surface(options, rounding), show));
  flat.bound += rounding;
  return flat;
}

}  // namespace

int export_mesh(const ExportOptions& options) {
  const std::optional<MeshFormat> format = mesh_format_of(options.output);
  if (!format) {
    throw UsageError(
        fmt::format("-o {}: the name must end in .obj, .ply, .stl or .glb.", options.output));
  }
  begin_outputs({options.model}, {options.output, options.json});
  Output file(options.output);
  OptionalOutput json_file(options.json);
  const BuiltMesh built = [&] {
    const BusyLine line("reading " + options.model);
    return build_mesh(read_model(options.model), options.model, options.mesh);
  }();
  say("{}: {}\n", options.model, describe(built.report));
  stop_if_interrupted();
  const BakedScene scene = named(options.model, [&] {
    return bake(built.mesh, {options.surface, options.alpha, SHELL_NORMAL});
  });
  const FlatMesh flat =
      flattened(options, built.mesh, scene, file_rounding(built.mesh, scene, *format));
  const std::size_t open_edges = count_open_edges(flat);
  stop_if_interrupted();
  {
    const BusyLine line("writing " + options.output);
    write_mesh(flat, *format, file.file());
    file.commit();
  }
  std::error_code unused;
  const auto bytes = std::filesystem::file_size(options.output, unused);
  say("{}: {} triangles, {} vertices, {}; off the surface by at most {:.3g} ({:.2g} of the "
      "radius)\n",
      options.output, flat.triangles.size(), flat.positions.size(),
      open_edges == 0 ? "closed" : fmt::format("{} open edges", open_edges), flat.bound,
      flat.bound / scene.extent);
  const bool reached = flat.beyond_error == 0;
  if (!reached) {
    say("{}: {:g} is not proven for {} of the triangles, {}\n", options.output, *options.error,
        flat.beyond_error,
        flat.off > 0.5 * *options.error
            ? fmt::format("whose vertices are up to {:.2g} off the surface: it is baked in "
                          "single precision, and neighbours' normals may not quite agree",
                          flat.off)
            : "where the surface is too steep");
  }
  if (json_file.is_wanted()) {
    nlohmann::ordered_json json{{"program", "trisect"},
                                {"version", TRISECT_VERSION},
                                {"model", options.model},
                                {"output", options.output},
                                {"surface", surface_name(options.surface)},
                                {"patches", scene.triangles.size()},
                                {"triangles", flat.triangles.size()},
                                {"vertices", flat.positions.size()},
                                {"open_edges", open_edges},
                                {"bound", flat.bound},
                                {"off", flat.off},
                                {"beyond_error", flat.beyond_error},
                                {"error", options.error ? nlohmann::ordered_json(*options.error)
                                                        : nlohmann::ordered_json()},
                                {"radius", scene.extent},
                                {"bytes", bytes}};
    json_file.write(json_text(json));
    json_file.commit();
  }
  return reached ? exit_done : exit_different;
}

}  // namespace trisect
