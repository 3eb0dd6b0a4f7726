#include "app/view/view_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <utility>

#include "app/base/error.h"
#include "app/cli/interrupt.h"
#include "app/cli/load_scene.h"
#include "app/view/flags.h"
#include "app/view/saved_picture.h"

namespace trisect::view {
namespace {

// Pixels of the longer side of an error map at most: the oracle takes long for each.
constexpr uint32_t kErrorSide = 200;

std::string saved_name(uint64_t number, bool exr) {
  return fmt::format("trisect-{}.{}", number, exr ? "exr" : "png");
}

}  // namespace

ViewCommands::ViewCommands(const gpu::Device& device, Window& window, Screen& screen,
                           ViewState& state, FrameScheduler& scheduler, FrameTracer& tracer,
                           ErrorOverlay& errors)
    : device_(device),
      window_(window),
      screen_(screen),
      state_(state),
      scheduler_(scheduler),
      tracer_(tracer),
      errors_(errors) {}

void ViewCommands::press(int key, int mods) {
  if (key == GLFW_KEY_ESCAPE) stop_turning();
  if (PanelLayer::wants_keys()) return;
  if ((mods & GLFW_MOD_CONTROL) != 0) {
    if (key == GLFW_KEY_C) copy_flags();
    if (key == GLFW_KEY_V) apply_flags(window_.clipboard());
    return;
  }
  Settings& settings = state_.settings;
  if (key == GLFW_KEY_H) settings.show_keys = !settings.show_keys;
  if (key == GLFW_KEY_TAB) settings.panel = !settings.panel;
  if (key == GLFW_KEY_O) settings.orbit = !settings.orbit;
  if (key == GLFW_KEY_F) frame_model();
  if (key == GLFW_KEY_F5) reload_shaders();
  if (key == GLFW_KEY_F12) save_next();
  if (key >= GLFW_KEY_1 && key <= GLFW_KEY_8) settings.shown = static_cast<uint>(key - GLFW_KEY_1);
}

void ViewCommands::obey(const Requests& requests) {
  if (requests.open) open_model(*requests.open);
  if (requests.frame_model) frame_model();
  if (requests.copy) copy_flags();
  if (requests.paste) apply_flags(window_.clipboard());
  if (requests.save) save_next();
  if (requests.reload_shaders) reload_shaders();
  if (requests.measure_error) measure_error();
}

void ViewCommands::stop_turning() {
  if (!state_.camera.is_turning()) return;
  state_.camera.stop_turning();
  window_.capture_cursor(false);
}

void ViewCommands::open_model(const std::string& file) {
  state_.settings.render.model = file;
  state_.settings.render.eye.reset();
  state_.settings.render.target.reset();
  state_.model.open(state_.settings.render);
}

void ViewCommands::take_loaded() {
  Facts& facts = state_.facts;
  const auto change = state_.model.poll(state_.settings.render, facts.message);
  facts.loading = state_.model.is_loading();
  if (!change) return;
  scheduler_.request_draws(FrameScheduler::kDrawsForPanel);
  if (*change == LoadedModel::Change::failed) return;
  facts.model = state_.model.file().summary;
  if (*change == LoadedModel::Change::rebaked) return;
  facts.message.clear();
  facts.recent = state_.model.recent();
  move_camera_to_model();
}

// Waits; false if the user interrupted the program.
bool ViewCommands::finish_loading() {
  while (state_.model.is_loading()) {
    if (!not_interrupted()) return false;
    window_.wait(0.01);
    take_loaded();
  }
  return true;
}

void ViewCommands::frame_model() {
  state_.settings.render.eye.reset();
  state_.settings.render.target.reset();
  move_camera_to_model();
}

void ViewCommands::move_camera_to_model() {
  if (state_.model.is_loaded()) state_.frame_model(window_.width(), window_.height());
}

void ViewCommands::copy_flags() {
  if (!state_.model.is_loaded()) return;
  const std::string flags = flags_of(state_.render_options());
  window_.set_clipboard(flags);
  state_.facts.message = "copied: " + flags;
}

void ViewCommands::apply_flags(const std::string& text) {
  const LoadedModel& model = state_.model;
  RenderOptions base;
  base.model = state_.settings.render.model;
  base.device = state_.settings.render.device;
  base.validation = state_.settings.render.validation;
  try {
    const RenderOptions options = with_flags(base, text);
    // Refuses a camera that is none.
    if (model.is_loaded()) {
      make_params(model.scene(), settings_of(options, model.mesh(), model.scene()));
    }
    state_.settings.render = options;
    state_.facts.message.clear();
    move_camera_to_model();
  } catch (const UsageError& error) {
    state_.facts.message = std::string("these are no flags: ") + error.what();
  }
  state_.model.request(state_.settings.render);
}

std::string ViewCommands::next_file() {
  const bool exr = state_.settings.exr;
  while (std::filesystem::exists(saved_name(last_saved_ + 1, exr))) ++last_saved_;
  return saved_name(last_saved_ + 1, exr);
}

bool ViewCommands::save(const std::string& file) {
  if (!finish_loading()) return false;
  screen_.wait();
  save_picture(device_, state_.model, state_.render_options(), file);
  state_.facts.message = "saved " + file;
  return true;
}

void ViewCommands::attempt(const std::function<void()>& action) {
  try {
    action();
  } catch (const DeviceLost&) {
    throw;
  } catch (const std::bad_alloc&) {
    state_.facts.message = kNoMemory;
  } catch (const std::exception& error) {
    state_.facts.message = error.what();
  }
}

void ViewCommands::save_next() {
  attempt([this] { save(next_file()); });
}

void ViewCommands::reload_shaders() {
  attempt([this] {
    auto code = state_.kernels.compile();
    // Kernels that the device refuses must not replace those that work.
    if (state_.model.is_loaded()) tracer_.prepare(code);
    state_.kernels.use(std::move(code));
    state_.facts.message = "compiled the kernels in " + state_.kernels.folder();
  });
}

void ViewCommands::watch_shaders() {
  if (!state_.kernels.has_changed(Clock::now())) return;
  reload_shaders();
  scheduler_.request_draws(FrameScheduler::kDrawsForPanel);
}

void ViewCommands::measure_error() {
  if (!finish_loading()) return;
  attempt([this] { start_measurement(); });
}

void ViewCommands::start_measurement() {
  screen_.wait();
  const LoadedModel& model = state_.model;
  const uint32_t longer_side = std::max(window_.width(), window_.height());
  const double scale = std::min(1.0, static_cast<double>(kErrorSide) / longer_side);
  const auto scaled = [&](uint32_t pixels) {
    return std::max(1U, static_cast<uint32_t>(std::lround(pixels * scale)));
  };
  const RenderOptions render =
      state_.render_options(scaled(window_.width()), scaled(window_.height()));
  const TraceParams params =
      make_params(model.scene(), settings_of(render, model.mesh(), model.scene()));
  KernelChoice choice = state_.kernel_choice(params.width, params.height);
  choice.aovs = true;
  choice.counts = false;
  choice.shadows = false;
  VulkanTracer tracer(device_, model.scene(), params.width, params.height, choice, kNoLimit,
                      state_.kernels.code().get());
  Frame frame;
  // Stopped by an interrupt, which ends the program.
  if (!tracer.render(params, frame, until_interrupted())) return;
  state_.facts.error.clear();
  state_.settings.shown = SHOWN_ERROR;
  errors_.start(state_.content(window_.width(), window_.height()), model.shared_scene(), params,
                std::move(frame));
}

}  // namespace trisect::view
