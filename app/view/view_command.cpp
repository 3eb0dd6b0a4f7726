#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "app/base/error.h"
#include "app/cli/cache_folder.h"
#include "app/cli/load_scene.h"
#include "app/cli/output.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/pipeline_store.h"
#include "app/picture/image_file.h"
#include "app/view/commands.h"
#include "app/view/viewer.h"

namespace trisect {

int view_model(const ViewOptions& options) {
  if (!options.screenshot.empty()) image_format(options.screenshot);
  // Refuses options that do not go together, whatever the model, before a window opens.
  chosen_accel(accel_request(options.render, true), Backend::vulkan, 1);
  std::vector<view::ScriptStep> script;
  if (!options.script.empty()) script = view::read_script(options.script);
  begin_outputs({options.render.model, options.script}, {options.screenshot, options.stats});
  OptionalOutput stats(options.stats);
  view::Window window(options.render.width, options.render.height, "trisect");
  const gpu::Instance instance(options.render.validation, window.vulkan_extensions());
  {
    const view::Surface surface(instance, window);
    const gpu::Device device(instance, options.render.device, surface.get());
    const PipelineStore store(device, cache_folder());
    view::Viewer viewer(options, std::move(script), window, instance, device, surface.get());
    viewer.run();
    say("{}", view::to_text(viewer.statistics()));
    stats.write(view::to_json(viewer.statistics()));
    stats.commit();
  }
  return report_validation(instance.log().messages());
}

}  // namespace trisect
