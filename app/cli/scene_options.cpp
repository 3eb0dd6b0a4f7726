#include "app/cli/scene_options.h"

#include "app/base/error.h"
#include "app/cli/command_options.h"
#include "app/cli/option_groups.h"
#include "app/cli/output.h"
#include "app/cli/suggestions.h"
#include "app/dispatch/accel.h"

namespace trisect {
namespace {

void add_gl_path(CLI::App& command, std::optional<std::string>& text) {
  command
      .add_option("--gl-path", text,
                  "How OpenGL traces: compute (Vulkan's kernel) or fragment (the thesis's "
                  "full-screen quad), default compute")
      ->group(option_group::kTracing)
      ->check(one_of({"compute", "fragment"}))
      ->type_name("NAME");
}

// Nothing for "auto".
std::optional<Accel> accel_of(const std::string& name) {
  for (const Accel accel : {Accel::list, Accel::tiles, Accel::bvh, Accel::rayquery}) {
    if (name == accel_name(accel)) return accel;
  }
  return std::nullopt;
}

// The options of add_view that change colours alone.
void add_look(CLI::App& command, RenderOptions& options, SceneText& text) {
  command
      .add_option("--light", text.light,
                  "Direction toward the light, of any length, default 0.35,0.8,0.5")
      ->group(option_group::kPicture)
      ->type_name("X,Y,Z");
  command
      .add_flag("--shadows", options.shadows,
                "Cast a ray from what is seen toward the light: the curved triangles shade "
                "each other and themselves (robust)")
      ->group(option_group::kPicture);
  command
      .add_option("--shading", text.shading,
                  "What colour the surface has: plain (lit), grid (lit, with the thesis's grid), "
                  "normal, patch or depth, default plain")
      ->group(option_group::kPicture)
      ->check(one_of({"plain", "grid", "normal", "patch", "depth"}))
      ->type_name("NAME");
  command
      .add_option(
          "--background", text.background,
          "What is behind the surface: sky, transparent or a colour as R,G,B from 0 to 1, default "
          "sky behind plain and grid, else 0,0,0")
      ->group(option_group::kPicture)
      ->check(suggest_names({"sky", "transparent"}))
      ->type_name("WHAT");
  command
      .add_option("--color", text.color,
                  "Colour of a plain surface or one with a grid, from 0 to 1, default those of the "
                  "file, or 0.62,0.72,0.82, with a grid 1,1,1")
      ->group(option_group::kPicture)
      ->type_name("R,G,B");
}

// The others: what rays there are, what they meet, and how that is found.
void add_tracing(CLI::App& command, RenderOptions& options, SceneText& text) {
  // The last of a repeated option counts.
  command.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  add_size(command, text.size, "800x600");
  add_surface(command, options.surface);
  add_alpha(command, options.alpha);
  command
      .add_option(
          "--shell", text.shell,
          "Along what triangles are displaced: normal (watertight) or height (the thesis's), "
          "default normal")
      ->group(option_group::kSurface)
      ->check(one_of({"normal", "height"}))
      ->type_name("NAME");
  command
      .add_option("--solver", text.solver,
                  "How roots are found: robust (the first one, surely) or bisect (the thesis's), "
                  "default robust")
      ->group(option_group::kTracing)
      ->check(one_of({"robust", "bisect"}))
      ->type_name("NAME");
  command
      .add_option(
          "--accel", text.accel,
          "What a ray is tried against: list (every patch, the thesis's), tiles (those "
          "that its tile of the image touches), bvh (those that a tree of boxes finds), rayquery "
          "(those that the device's own structure finds, where it has ray queries; all three "
          "vulkan, robust) or auto, default auto")
      ->group(option_group::kTracing)
      ->check(one_of({"list", "tiles", "bvh", "rayquery", "auto"}))
      ->type_name("NAME");
  command
      .add_option(
          "--preset", text.preset,
          "thesis: --shell height --solver bisect --rank 10 --shading grid, but for what is "
          "given beside")
      ->group(option_group::kTracing)
      ->check(one_of({"thesis"}))
      ->type_name("NAME");
  command
      .add_option("--rank", text.rank,
                  "bisect: resolves a triangle's chord to 2^-N, 1 to 60, default 10")
      ->group(option_group::kTracing)
      ->check(number_from_to(1, 60))
      ->type_name("N");
  command.add_option("--eye", text.eye, "Position of the camera, default: frames the model")
      ->group(option_group::kCamera)
      ->type_name("X,Y,Z");
  command
      .add_option("--target", text.target,
                  "Point that the camera looks at, default: the model's centre")
      ->group(option_group::kCamera)
      ->type_name("X,Y,Z");
  command.add_option("--up", text.up, "Up vector of the camera, default 0,1,0")
      ->group(option_group::kCamera)
      ->type_name("X,Y,Z");
  command
      .add_option("--fov", options.fov, "Vertical field of view in degrees, 1 to 170, default 45")
      ->group(option_group::kCamera)
      ->check(number_from_to(1.0, 170.0))
      ->type_name("DEG");
  add_mesh_options(command, options.mesh);
}

}  // namespace

uint shading_of(const std::string& name) {
  for (uint shading = SHADING_PLAIN; shading < SHADING_DEPTH; ++shading) {
    if (name == shading_name(shading)) return shading;
  }
  return SHADING_DEPTH;
}

void add_scene(CLI::App& command, RenderOptions& options, SceneText& text) {
  add_traced_scene(command, options, text);
  add_look(command, options, text);
}

void add_traced_scene(CLI::App& command, RenderOptions& options, SceneText& text) {
  // As for the options of add_view, the last one counts.
  command.add_option("MODEL", options.model, "OBJ, glTF, PLY, STL or FBX file")
      ->group(option_group::kModel)
      ->required()
      ->take_last()
      ->check(not_empty())
      ->check(suggest_models());
  add_tracing(command, options, text);
  add_gl_path(command, text.gl_path);
  add_device(command, options.device);
  command
      .add_flag_callback("-v,--verbose", be_verbose,
                         "Say more on standard error: what each step took, why which acceleration, "
                         "what the device has")
      ->group(option_group::kOutput);
}

void add_view(CLI::App& command, RenderOptions& options, SceneText& text) {
  add_tracing(command, options, text);
  add_look(command, options, text);
}

void add_mesh_options(CLI::App& command, MeshOptions& mesh) {
  command
      .add_option("--crease", mesh.crease_degrees,
                  "Rebuild the normals, sharp where faces meet at more than this angle, 0 to 180")
      ->group(option_group::kModel)
      ->check(number_from_to(0.0, 180.0))
      ->type_name("DEG");
  command
      .add_option(
          "--weld", mesh.weld,
          "Take vertices for one that are no farther apart than this, in the model's units, "
          "default 0")
      ->group(option_group::kModel)
      ->check(number_from_to(0.0, 1e9))
      ->type_name("EPS");
  command
      .add_flag("--repair", mesh.repair,
                "Turn triangles around so that neighbours have the same winding, outward where "
                "the surface is closed")
      ->group(option_group::kModel);
}

void add_spp(CLI::App& command, uint32_t& spp) {
  command
      .add_option("--spp", spp, "Rays a pixel, averaged in linear light: 1, 4, 9 or 16, default 1")
      ->group(option_group::kPicture)
      ->check(one_of({"1", "4", "9", "16"}))
      ->type_name("N");
}

void parse_scene(const SceneText& text, RenderOptions& options) {
  if (text.gl_path) {
    options.gl_path = *text.gl_path == "fragment" ? GlPath::fragment : GlPath::compute;
  }
  if (text.preset) {
    options.shell = SHELL_HEIGHT;
    options.solver = SOLVER_BISECT;
    options.rank = RenderOptions{}.rank;
    options.shading = SHADING_GRID;
  }
  if (text.shell) options.shell = shell_of(*text.shell);
  if (text.solver) options.solver = *text.solver == "bisect" ? SOLVER_BISECT : SOLVER_ROBUST;
  if (text.rank) options.rank = *text.rank;
  if (text.accel) options.accel = accel_of(*text.accel);
  if (text.size) parse_size("--size", *text.size, options.width, options.height);
  if (text.eye) options.eye = parse_triple("--eye", *text.eye);
  if (text.target) options.target = parse_triple("--target", *text.target);
  if (text.up) options.up = parse_triple("--up", *text.up);
  if (options.shadows && options.solver == SOLVER_BISECT) {
    throw UsageError("--shadows: it needs --solver robust.");
  }
  if (options.shadows && options.gl_path == GlPath::fragment) {
    throw UsageError("--shadows: it needs --gl-path compute.");
  }
  if (text.shading) options.shading = shading_of(*text.shading);
  if (text.color) options.color = parse_color("--color", *text.color);
  if (text.background) {
    options.background = *text.background == "sky"           ? Background::sky
                         : *text.background == "transparent" ? Background::none
                                                             : Background::color;
    if (options.background == Background::color) {
      options.background_color =
          parse_color("--background", *text.background, "sky, transparent or ");
    }
  }
  if (options.color && !is_lit(options.shading.value_or(SHADING_PLAIN))) {
    throw UsageError("--color: a surface with --shading normal, patch or depth has others.");
  }
  if (options.shadows && !is_lit(options.shading.value_or(SHADING_PLAIN))) {
    throw UsageError(
        "--shadows: no light falls on a surface with --shading normal, patch or depth.");
  }
  if (text.light) options.light = parse_direction("--light", *text.light);
}

}  // namespace trisect
