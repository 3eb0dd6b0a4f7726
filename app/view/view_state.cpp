#include "app/view/view_state.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "app/cli/cache_folder.h"
#include "app/cli/load_scene.h"
#include "app/dispatch/accel.h"
#include "app/mesh/model_file.h"

namespace trisect::view {
namespace {

std::vector<std::string> models_in(const std::filesystem::path& folder) {
  std::vector<std::string> models;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (is_model_name(entry.path())) models.push_back(entry.path().string());
  }
  std::sort(models.begin(), models.end());
  return models;
}

}  // namespace

ViewState::ViewState(const ViewOptions& options, const gpu::Device& device)
    : model(cache_folder()),
      camera(Clock::now()),
      kernels(options.shaders),
      has_subgroups_(device.subgroup_size() != 0) {
  settings.render = options.render;
  settings.frame_ms = options.frame_ms;
  facts.device = device.report().name;
  facts.driver = device.report().driver;
  facts.ray_query = device.has_ray_query();
  facts.models = models_in(options.assets);
  facts.recent = model.recent();
}

RenderOptions ViewState::render_options() const {
  RenderOptions render = settings.render;
  const Camera& seen_by = camera.camera();
  render.eye = seen_by.eye;
  render.target = seen_by.target;
  render.up = seen_by.up;
  render.fov = seen_by.fov;
  // Not those of the settings, whose scene may still be loading.
  const SceneRequest& shown = model.shown();
  render.model = shown.model;
  render.mesh = shown.mesh;
  render.surface = shown.choice.surface;
  render.alpha = shown.choice.alpha;
  render.shell = shown.choice.shell;
  return render;
}

RenderOptions ViewState::render_options(uint32_t width, uint32_t height) const {
  RenderOptions render = render_options();
  render.width = width;
  render.height = height;
  render.spp = 1;
  return render;
}

KernelChoice ViewState::kernel_choice(uint32_t width, uint32_t height) const {
  const RenderOptions render = render_options(width, height);
  const bool needs_aovs = settings.shown != SHOWN_COLOR && settings.shown != SHOWN_ERROR;
  KernelChoice choice;
  choice.solver = render.solver;
  choice.counts = settings.counts || settings.shown == SHOWN_EVALUATIONS;
  choice.aovs = needs_aovs || choice.counts;
  choice.shadows = render.shadows;
  // The scene's tree may still be loading; until then the list does.
  choice.accel = accel_at_hand(accel_request(render, has_subgroups_), model.scene());
  return choice;
}

FrameContent ViewState::content(uint32_t width, uint32_t height) const {
  FrameContent content;
  content.render = render_options(0, 0);
  content.scene = model.number();
  content.code = kernels.number();
  content.kernels = kernel_choice(width, height);
  content.width = width;
  content.height = height;
  return content;
}

void ViewState::frame_model(uint32_t width, uint32_t height) {
  RenderOptions framed = settings.render;
  // A minimised window has no size.
  framed.width = std::max(width, 1U);
  framed.height = std::max(height, 1U);
  framed.spp = 1;
  camera.set(settings_of(framed, model.mesh(), model.scene()).camera, model.scene().radius);
}

}  // namespace trisect::view
