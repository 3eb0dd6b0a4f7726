#include "app/view/command_line.h"

#include "app/cli/command_options.h"
#include "app/cli/data_folder.h"
#include "app/cli/option_groups.h"
#include "app/cli/suggestions.h"
#include "app/view/commands.h"

namespace trisect::view {

CommandLine::CommandLine(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("view", "Show a model in a window and walk around it");
  options_.assets = data_folder("assets", TRISECT_ASSETS).string();
  options_.shaders = data_folder("shaders", TRISECT_SHADERS).string();
  options_.render.model = options_.assets + "/teapot.obj";
  add_view(command, options_.render, text_);
  command
      .add_option("MODEL", options_.render.model,
                  "OBJ, glTF, PLY, STL or FBX file, default the teapot")
      ->group(option_group::kModel)
      ->check(not_empty())
      ->check(suggest_models());
  add_spp(command, options_.render.spp);
  command
      .add_option("--frame-ms", options_.frame_ms,
                  "Milliseconds that a frame may take while something moves, 5 to 500, default 33: "
                  "the resolution gives way")
      ->group(option_group::kWindow)
      ->check(number_from_to(5.0, 500.0))
      ->type_name("MS");
  command.add_option("--assets", options_.assets, "Folder of the models to choose from")
      ->group(option_group::kWindow)
      ->check(not_empty())
      ->check(suggest_folders())
      ->type_name("DIR");
  command.add_option("--shaders", options_.shaders, "Folder of the sources that F5 compiles")
      ->group(option_group::kWindow)
      ->check(not_empty())
      ->check(suggest_folders())
      ->type_name("DIR");
  command.add_flag("--watch", options_.watch, "Compile the shaders whenever one is written")
      ->group(option_group::kWindow);
  command.add_option("--frames", frames_, "End after so many frames")
      ->group(option_group::kWindow)
      ->check(number_from_to(1, 1000000000))
      ->type_name("N");
  command
      .add_option("--screenshot", options_.screenshot,
                  "Save a picture at the end, as trisect render would: .png or .exr")
      ->group(option_group::kOutput)
      ->check(not_empty())
      ->check(suggest_images())
      ->type_name("FILE");
  command
      .add_option("--script", options_.script,
                  "Do what the lines `SECONDS COMMAND ARGUMENT` say: hold KEY SECONDS, press KEY, "
                  "flags FLAGS, shown NAME, size WxH, open FILE, save FILE, error, quit")
      ->group(option_group::kWindow)
      ->check(not_empty())
      ->check(suggest_files({}))
      ->type_name("FILE");
  command.add_option("--stats", options_.stats, "Write how fast it was as JSON")
      ->group(option_group::kOutput)
      ->check(not_empty())
      ->check(suggest_files({".json"}))
      ->type_name("FILE");
  add_validation(command, options_.render.validation);
  add_device(command, options_.render.device);
}

int CommandLine::run() {
  parse_scene(text_, options_.render);
  if (frames_ > 0) options_.frames = frames_;
  return view_model(options_);
}

}  // namespace trisect::view
