// What a window is told to do, by keys, mouse, panel or script.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <utility>

#include "app/base/error.h"
#include "app/cli/interrupt.h"
#include "app/cli/load_scene.h"
#include "app/view/flags.h"
#include "app/view/kernel_compiler.h"
#include "app/view/saved_picture.h"
#include "app/view/viewer.h"
#include "vk/result.h"

namespace trisect::view {
namespace {

// A pixel of the mouse's way turns the camera by so much, in radians.
constexpr double kTurn = 0.004;

// The side of an error map, in pixels: the oracle takes its time for each.
constexpr uint32_t kErrorSide = 200;

// Seconds from one look at the shaders' folder to the next.
constexpr double kWatch = 0.25;

// Of a picture that is saved under a name of this program's own.
std::string saved_name(uint64_t number, bool exr) {
  return fmt::format("trisect-{}.{}", number, exr ? "exr" : "png");
}

}  // namespace

std::filesystem::file_time_type last_change(const std::filesystem::path& folder) {
  // The clock of files may count from a day to come.
  auto last = std::filesystem::file_time_type::min();
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    last = std::max(last, entry.last_write_time(error));
  }
  return last;
}

bool Viewer::is_held(int key) const {
  const bool scripted = std::any_of(held_.begin(), held_.end(), [&](const auto& held) {
    return held.first == key && held.second > since_start();
  });
  return scripted || (!PanelLayer::wants_keys() && glfwGetKey(window_.get(), key) == GLFW_PRESS);
}

glm::dvec3 Viewer::steps() const {
  const auto axis = [&](bool ahead, bool back) { return (ahead ? 1.0 : 0.0) - (back ? 1.0 : 0.0); };
  const bool down = is_held(GLFW_KEY_LEFT_SHIFT) || is_held(GLFW_KEY_RIGHT_SHIFT);
  return {axis(is_held(GLFW_KEY_D), is_held(GLFW_KEY_A)), axis(is_held(GLFW_KEY_SPACE), down),
          axis(is_held(GLFW_KEY_W), is_held(GLFW_KEY_S))};
}

bool Viewer::is_walking() const {
  return steps() != glm::dvec3(0.0);
}

void Viewer::take_input() {
  const Input input = window_.take();
  if (input.any) redraws_ = std::max(redraws_, 3);
  if (input.resized) swapchain_.outdate();
  if (!PanelLayer::wants_mouse()) wheel_ += input.wheel;
  for (const KeyPress& press_of : input.keys) press(press_of.key, press_of.mods);
  if (!input.dropped.empty()) open(input.dropped.back());
}

void Viewer::press(int key, int mods) {
  if (key == GLFW_KEY_ESCAPE) release_cursor();
  if (PanelLayer::wants_keys()) return;
  if ((mods & GLFW_MOD_CONTROL) != 0) {
    if (key == GLFW_KEY_C) copy_flags();
    if (key == GLFW_KEY_V) paste_clipboard();
    return;
  }
  if (key == GLFW_KEY_H) settings_.show_keys = !settings_.show_keys;
  if (key == GLFW_KEY_TAB) settings_.panel = !settings_.panel;
  if (key == GLFW_KEY_O) settings_.orbit = !settings_.orbit;
  if (key == GLFW_KEY_F) frame_model();
  if (key == GLFW_KEY_F5) reload_shaders();
  if (key == GLFW_KEY_F12) save_next();
  if (key >= GLFW_KEY_1 && key <= GLFW_KEY_8) settings_.shown = static_cast<uint>(key - GLFW_KEY_1);
}

void Viewer::follow_script() {
  while (first_frame_ && next_step_ < script_.size() &&
         script_[next_step_].seconds <= since_start()) {
    const ScriptStep& step = script_[next_step_++];
    redraws_ = std::max(redraws_, 3);
    std::istringstream words(step.argument);
    if (step.command == "hold") {
      std::string name;
      double seconds = 0.0;
      words >> name >> seconds;
      held_.emplace_back(key_named(name), since_start() + seconds);
    } else if (step.command == "press") {
      press(key_named(step.argument), 0);
    } else if (step.command == "flags") {
      paste(step.argument);
    } else if (step.command == "shown") {
      settings_.shown = shown_named(step.argument).value_or(SHOWN_COLOR);
    } else if (step.command == "size") {
      uint32_t width = 0;
      uint32_t height = 0;
      parse_size("size", step.argument, width, height);
      window_.resize(width, height);
    } else if (step.command == "open") {
      open(step.argument);
    } else if (step.command == "save") {
      save(step.argument);
    } else if (step.command == "error") {
      measure_error();
    } else {
      quits_ = true;
    }
  }
}

void Viewer::release_cursor() {
  if (!std::exchange(turning_, false)) return;
  glfwSetInputMode(window_.get(), GLFW_CURSOR, GLFW_CURSOR_NORMAL);
}

void Viewer::move_camera() {
  const Clock::time_point now = Clock::now();
  // A pause is no step: what is held begins to move from here.
  const double seconds =
      std::min(std::chrono::duration<double>(now - std::exchange(last_loop_, now)).count(), 0.1);
  const bool pressed = glfwGetMouseButton(window_.get(), GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
  Motion motion;
  motion.wheel = std::exchange(wheel_, 0.0);
  glm::dvec2 cursor;
  glfwGetCursorPos(window_.get(), &cursor.x, &cursor.y);
  if (!pressed) {
    release_cursor();
    may_turn_ = !PanelLayer::wants_mouse();
  } else if (turning_) {
    motion.turn = glm::dvec2(cursor.x - cursor_.x, cursor_.y - cursor.y) * kTurn;
  } else if (may_turn_ && !PanelLayer::wants_mouse()) {
    turning_ = true;
    // After Esc the button has to be pressed again.
    may_turn_ = false;
    glfwSetInputMode(window_.get(), GLFW_CURSOR, GLFW_CURSOR_DISABLED);
    glfwGetCursorPos(window_.get(), &cursor.x, &cursor.y);
  }
  cursor_ = cursor;
  motion.steps = steps();
  navigator_.set_orbits(settings_.orbit);
  if (scene_) navigator_.move(motion, seconds);
}

void Viewer::build_panel_and_obey() {
  PanelLayer::begin();
  facts_.save_file = next_file();
  facts_.error_progress = error_.progress();
  facts_.error = shows_errors() ? error_map_.summary : "";
  if (facts_.error.empty() && !error_map_.errors.empty() && settings_.shown == SHOWN_ERROR) {
    facts_.error = "measured of another view; here is the colour";
  }
  const Requests requests = build_panel(settings_, facts_);
  PanelLayer::end();
  if (requests.open) open(*requests.open);
  if (requests.frame_model) frame_model();
  if (requests.copy) copy_flags();
  if (requests.paste) paste_clipboard();
  if (requests.save) save_next();
  if (requests.reload_shaders) reload_shaders();
  if (requests.measure_error) measure_error();
  load();
}

void Viewer::frame_model() {
  settings_.render.eye.reset();
  settings_.render.target.reset();
  if (scene_) frame_now();
}

void Viewer::frame_now() {
  RenderOptions framed = settings_.render;
  framed.width = std::max(window_.width(), 1U);
  framed.height = std::max(window_.height(), 1U);
  framed.spp = 1;
  navigator_.set(settings_of(framed, *scene_->mesh, *scene_->scene).camera);
  navigator_.set_speed(scene_->scene->radius);
}

void Viewer::copy_flags() {
  if (!scene_) return;
  const std::string flags = flags_of(render_now());
  glfwSetClipboardString(window_.get(), flags.c_str());
  facts_.message = "copied: " + flags;
}

void Viewer::paste_clipboard() {
  const char* text = glfwGetClipboardString(window_.get());
  paste(text == nullptr ? "" : text);
}

void Viewer::paste(const std::string& flags) {
  RenderOptions base;
  base.model = settings_.render.model;
  base.device = settings_.render.device;
  base.validation = settings_.render.validation;
  try {
    const RenderOptions pasted = with_flags(base, flags);
    if (scene_) make_params(*scene_->scene, settings_of(pasted, *scene_->mesh, *scene_->scene));
    settings_.render = pasted;
    facts_.message.clear();
    if (scene_) frame_now();
  } catch (const UsageError& error) {
    facts_.message = std::string("these are no flags: ") + error.what();
  }
  load();
}

std::string Viewer::next_file() {
  while (std::filesystem::exists(saved_name(saved_ + 1, settings_.exr))) ++saved_;
  return saved_name(saved_ + 1, settings_.exr);
}

void Viewer::finish_loading() {
  while (loader_.is_busy()) {
    stop_if_interrupted();
    window_.wait(0.01);
    take_loaded();
  }
}

void Viewer::save(const std::string& file) {
  finish_loading();
  swapchain_.wait();
  save_picture(device_, *scene_->mesh, *scene_->scene, render_now(), file);
  facts_.message = "saved " + file;
}

void Viewer::save_next() {
  try {
    save(next_file());
  } catch (const std::exception& error) {
    facts_.message = error.what();
  }
}

void Viewer::reload_shaders() {
  try {
    auto code = std::make_shared<const KernelCode>(compile_kernels(options_.shaders));
    if (scene_) {
      swapchain_.wait();
      still_.use(scene_->scene, shown_now().kernels, code);
    }
    code_ = std::move(code);
    ++code_number_;
    facts_.message = "compiled the kernels in " + options_.shaders;
  } catch (const std::exception& error) {
    facts_.message = error.what();
  }
}

void Viewer::watch_shaders() {
  const Clock::time_point now = Clock::now();
  if (std::chrono::duration<double>(now - watched_).count() < kWatch) return;
  watched_ = now;
  const auto last = last_change(options_.shaders);
  if (last == shaders_changed_) return;
  shaders_changed_ = last;
  reload_shaders();
  redraws_ = 3;
}

void Viewer::measure_error() {
  finish_loading();
  try {
    start_measurement();
  } catch (const UsageError& error) {
    facts_.message = error.what();
  } catch (const DeviceError& error) {
    facts_.message = error.what();
  }
}

void Viewer::start_measurement() {
  swapchain_.wait();
  const double shrink =
      std::min(1.0, static_cast<double>(kErrorSide) / std::max(window_.width(), window_.height()));
  const auto side = [&](uint32_t pixels) {
    return std::max(1U, static_cast<uint32_t>(std::lround(pixels * shrink)));
  };
  const RenderOptions render = render_at(side(window_.width()), side(window_.height()));
  const TraceParams params =
      make_params(*scene_->scene, settings_of(render, *scene_->mesh, *scene_->scene));
  KernelChoice choice = kernels_wanted(params.width, params.height);
  choice.aovs = true;
  choice.counts = false;
  choice.shadows = false;
  VulkanTracer tracer(device_, *scene_->scene, params.width, params.height, choice, kNoLimit,
                      code_.get());
  Frame frame;
  finished(tracer.render(params, frame, not_interrupted));
  error_of_ = shown_now();
  error_map_ = {};
  facts_.error.clear();
  settings_.shown = SHOWN_ERROR;
  error_.start(scene_->scene, params, std::move(frame));
}

bool Viewer::shows_errors() const {
  if (settings_.shown != SHOWN_ERROR || error_map_.errors.empty() || !scene_) return false;
  Shown now = shown_now();
  now.kernels = error_of_.kernels;
  return now == error_of_;
}

void Viewer::show_errors() {
  if (error_map_.errors.empty()) return;
  swapchain_.wait();
  const std::size_t bytes = error_map_.errors.size() * sizeof(vec4);
  error_buffer_.emplace(device_, bytes, gpu::Memory::host, "errors");
  std::memcpy(error_buffer_->bytes().data(), error_map_.errors.data(), bytes);
}

}  // namespace trisect::view
