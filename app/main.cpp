// The program: parses the command line, runs a command, turns errors into sentences and exit codes.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <map>
#include <string>

#include "app/commands.h"
#include "app/error.h"
#include "app/interrupt.h"
#include "vk/result.h"

namespace trisect {
namespace {

int fail(int code, const std::string& message) {
  std::fprintf(stderr, "trisect: %s\n", message.c_str());
  return code;
}

// Options that CLI11 hands over as text and options.h parses.
struct RenderText {
  std::string size;
  std::string eye;
  std::string target;
  std::string up;
};

void add_render(CLI::App& app, RenderOptions& options, RenderText& text) {
  const std::map<std::string, uint> surfaces{
      {"flat", SURFACE_FLAT}, {"phong", SURFACE_PHONG}, {"sphere", SURFACE_SPHERE}};
  const std::map<std::string, int> solvers{{"bisect", 0}};
  constexpr double largest = std::numeric_limits<float>::max();

  CLI::App* render = app.add_subcommand("render", "Render a model to an image file");
  render->add_option("MODEL", options.model, "OBJ file")->required();
  render
      ->add_option("-o,--output", options.output,
                   "Image to write: FILE.png (8-bit sRGB) or FILE.exr "
                   "(linear float with AOVs)")
      ->required()
      ->type_name("FILE");
  render->add_option("--size", text.size, "Image size in pixels, default 800x600")
      ->type_name("WxH");
  render
      ->add_option("--surface", options.surface,
                   "How triangles are curved: flat, phong or sphere, "
                   "default phong")
      ->transform(CLI::CheckedTransformer(surfaces).description(""))
      ->type_name("NAME");
  render
      ->add_option("--alpha", options.alpha,
                   "phong: from 0 (flat) to 1 (full projection) and beyond, "
                   "default 0.65")
      ->check(CLI::Range(-1000.0, 1000.0).description(""))
      ->type_name("A");
  render
      ->add_option_function<std::string>(
          "--solver", [](const std::string&) {}, "How roots are found: bisect, the default")
      ->check(CLI::IsMember(solvers).description(""))
      ->type_name("NAME");
  render
      ->add_option("--rank", options.rank,
                   "bisect: resolution of 2^-N of a triangle's chord, 1 to 60, "
                   "default 10")
      ->check(CLI::Range(1, 60).description(""))
      ->type_name("N");
  render->add_option("--eye", text.eye, "Position of the camera, default: frames the model")
      ->type_name("X,Y,Z");
  render->add_option("--target", text.target, "Point it looks at, default: the model's centre")
      ->type_name("X,Y,Z");
  render->add_option("--up", text.up, "Its up vector, default 0,1,0")->type_name("X,Y,Z");
  render
      ->add_option("--fov", options.fov,
                   "Its vertical field of view in degrees, 1 to 170, default 45")
      ->check(CLI::Range(1.0, 170.0).description(""))
      ->type_name("DEG");
  render
      ->add_option("--crease", options.crease,
                   "Rebuild the normals, sharp where faces meet at more than "
                   "this angle, 0 to 180")
      ->check(CLI::Range(0.0, 180.0).description(""))
      ->type_name("DEG");
  render
      ->add_option("--device", options.device,
                   "Vulkan device, by its number in `trisect devices` or a "
                   "part of its name")
      ->type_name("D");
  render->add_flag("--validation", options.validation,
                   "Run under the Vulkan validation layer, fail on any "
                   "message");
  render->add_option("--runs", options.runs, "Frames to time after a warm-up, default 1")
      ->check(CLI::Range(1, 1000000).description(""))
      ->type_name("N");
  render->add_option("--stats", options.stats, "Write the figures as JSON")->type_name("FILE.json");
  static_cast<void>(largest);
}

int run(int argc, char** argv) {
  CLI::App app("Ray-traces triangle models as smooth curved surfaces in a Vulkan compute shader.",
               "trisect");
  app.set_version_flag("--version", std::string("trisect ") + TRISECT_VERSION);
  app.require_subcommand(1);
  RenderOptions options;
  RenderText text;
  add_render(app, options, text);
  app.add_subcommand("devices", "List the Vulkan devices, and what those that cannot be used lack");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    return fail(exit_usage, std::string(error.what()) + " (see trisect --help)");
  }
  if (app.got_subcommand("devices")) return list_devices();
  if (!text.size.empty()) parse_size("--size", text.size, options.width, options.height);
  if (!text.eye.empty()) options.eye = parse_triple("--eye", text.eye);
  if (!text.target.empty()) options.target = parse_triple("--target", text.target);
  if (!text.up.empty()) options.up = parse_triple("--up", text.up);
  return render(options);
}

}  // namespace
}  // namespace trisect

int main(int argc, char** argv) {
  using namespace trisect;
  try {
    catch_interrupts();
    return run(argc, argv);
  } catch (const UsageError& error) {
    return fail(exit_usage, error.what());
  } catch (const InputError& error) {
    return fail(exit_bad_input, error.what());
  } catch (const gpu::Error& error) {
    return fail(exit_no_device, error.what());
  } catch (const Interrupted& error) {
    return fail(exit_interrupted, error.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_bad_input, "not enough memory for this model and image size.");
  } catch (const std::exception& error) {
    return fail(exit_internal, std::string("internal error: ") + error.what());
  }
}
