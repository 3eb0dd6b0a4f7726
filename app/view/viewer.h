// The loop of `trisect view`: input, loading, motion, tracing, drawing.
#pragma once

#include <string>
#include <vector>

#include "app/view/error_overlay.h"
#include "app/view/frame_scheduler.h"
#include "app/view/frame_tracer.h"
#include "app/view/options.h"
#include "app/view/screen.h"
#include "app/view/script_runner.h"
#include "app/view/view_commands.h"
#include "app/view/view_state.h"
#include "app/view/view_statistics.h"
#include "app/view/window.h"

namespace trisect::view {

// Not thread safe.
class Viewer {
 public:
  // The window, the instance, the device and the surface must outlive the viewer. script: as
  // read_script() returns it. Throws DeviceError.
  Viewer(const ViewOptions& options, std::vector<ScriptStep> script, Window& window,
         const gpu::Instance& instance, const gpu::Device& device, VkSurfaceKHR surface);
  // The device may still read the last frame, which is destroyed before the screen.
  ~Viewer() { screen_.finish(); }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;
  Viewer(Viewer&&) = delete;
  Viewer& operator=(Viewer&&) = delete;

  // Returns once the window is closed, the script quits or options.frames frames have been shown,
  // after the screenshot is written. Throws InputError if the first model cannot be loaded or a
  // file that the command line names cannot be written; DeviceError; Interrupted.
  void run();

  [[nodiscard]] const ViewStatistics& statistics() const { return statistics_; }

 private:
  // Drivers compile on the way to the first frames: the third one shows that everything is ready.
  static constexpr uint64_t kFramesToStart = 3;

  void loop_once();
  // Seconds for which the loop may sleep if no input comes.
  [[nodiscard]] double seconds_to_wait() const;
  void take_input();
  void follow_script();
  void move_camera();
  void poll_errors();
  // Lays out the panel and does what it asks for.
  void update_panel();
  [[nodiscard]] FrameTracer::Result trace();
  void show();
  void record(const MovingFrame& frame, double loop_ms);

  [[nodiscard]] bool is_minimised() const;
  [[nodiscard]] bool is_held(int key, Clock::time_point now) const;
  [[nodiscard]] WalkKeys walk_keys(Clock::time_point now) const;
  [[nodiscard]] bool shows_errors() const;
  [[nodiscard]] ScreenPush screen_push(bool shows_errors) const;
  void name_model_in_title();

  ViewOptions options_;
  Window& window_;
  const gpu::Device& device_;
  Screen screen_;
  ViewState state_;
  FrameScheduler scheduler_;
  FrameTracer tracer_;
  ErrorOverlay errors_;
  ViewCommands commands_;
  ScriptRunner script_;
  ViewStatistics statistics_;
};

}  // namespace trisect::view
