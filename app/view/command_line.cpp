#include "app/view/command_line.h"

#include "app/cli/command_options.h"
#include "app/cli/data_folder.h"
#include "app/view/commands.h"

namespace trisect::view {

CommandLine::CommandLine(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("view", "Show a model in a window and walk around it");
  options_.assets = data_folder("assets", TRISECT_ASSETS).string();
  options_.shaders = data_folder("shaders", TRISECT_SHADERS).string();
  options_.render.model = options_.assets + "/teapot.obj";
  add_view(command, options_.render, text_);
  command.add_option("MODEL", options_.render.model,
                     "OBJ, glTF, PLY, STL or FBX file, default the teapot");
  add_spp(command, options_.render.spp);
  command
      .add_option("--frame-ms", options_.frame_ms,
                  "Milliseconds that a frame may take while something moves, 5 to 500, default 33: "
                  "the resolution gives way")
      ->check(number_from_to(5.0, 500.0))
      ->type_name("MS");
  command.add_option("--assets", options_.assets, "Folder of the models to choose from")
      ->check(not_empty())
      ->type_name("DIR");
  command.add_option("--shaders", options_.shaders, "Folder of the sources that F5 compiles")
      ->check(not_empty())
      ->type_name("DIR");
  command.add_flag("--watch", options_.watch, "Compile them whenever one is written");
  command.add_option("--frames", frames_, "End after so many frames")
      ->check(number_from_to(1, 1000000000))
      ->type_name("N");
  command
      .add_option("--screenshot", options_.screenshot,
                  "Save a picture at the end, as trisect render would: .png or .exr")
      ->check(not_empty())
      ->type_name("FILE");
  command
      .add_option("--script", options_.script,
                  "Do what the lines `SECONDS COMMAND ARGUMENT` say: hold KEY SECONDS, press KEY, "
                  "flags FLAGS, shown NAME, size WxH, open FILE, save FILE, error, quit")
      ->check(not_empty())
      ->type_name("FILE");
  command.add_option("--stats", options_.stats, "Write how fast it was as JSON")
      ->check(not_empty())
      ->type_name("FILE");
  command.add_flag("--validation", options_.render.validation,
                   "Run under the Vulkan validation layer, fail on any message");
  add_device(command, options_.render.device);
}

int CommandLine::run() {
  parse_scene(text_, options_.render);
  if (frames_ > 0) options_.frames = frames_;
  return view_model(options_);
}

}  // namespace trisect::view
