// What the user can have done: by keys, files dragged into the window, the panel or a script.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "app/view/error_overlay.h"
#include "app/view/frame_tracer.h"
#include "app/view/panel.h"
#include "app/view/screen.h"
#include "app/view/script_runner.h"
#include "app/view/view_state.h"
#include "app/view/window.h"

namespace trisect::view {

// Commands change the state, or report in the panel why they could not. Not thread safe.
class ViewCommands : public ScriptActions {
 public:
  // All of them must outlive this object.
  ViewCommands(const gpu::Device& device, Window& window, Screen& screen, ViewState& state,
               FrameScheduler& scheduler, FrameTracer& tracer, ErrorOverlay& errors);

  // mods: GLFW_MOD_... Esc frees the cursor; the panel takes every other key while it is typed
  // into.
  void press(int key, int mods);
  void obey(const Requests& requests);

  // Frees the cursor if the mouse turns the camera.
  void stop_turning();

  // Takes over a model that has been loaded. Throws what the first one fails with.
  void take_loaded();

  // Saves the view under this name, once its model is loaded; false if the user interrupted the
  // program meanwhile. Throws UsageError, InputError or DeviceError.
  bool save(const std::string& file);

  // Compiles the kernels if their sources have changed.
  void watch_shaders();

  // The name under which F12 would save the view: the next number without a file.
  std::string next_file();

  // As a script has it: errors of save_picture_to() are thrown.
  void press_key(int key) override { press(key, 0); }
  void apply_flags(const std::string& text) override;
  void show_output(unsigned int output) override { state_.settings.shown = output; }
  void resize_window(uint32_t width, uint32_t height) override { window_.resize(width, height); }
  void open_model(const std::string& file) override;
  void save_picture_to(const std::string& file) override { save(file); }
  void measure_error() override;
  void quit() override { window_.close(); }

 private:
  bool finish_loading();
  void frame_model();
  void move_camera_to_model();
  void copy_flags();
  // What the action fails with becomes a message in the panel. Throws DeviceLost.
  void attempt(const std::function<void()>& action);
  void save_next();
  void reload_shaders();
  void start_measurement();

  const gpu::Device& device_;
  Window& window_;
  Screen& screen_;
  ViewState& state_;
  FrameScheduler& scheduler_;
  FrameTracer& tracer_;
  ErrorOverlay& errors_;
  uint64_t last_saved_ = 0;  // number of the last picture known to exist
};

}  // namespace trisect::view
