// The window: input, motion, loading, tracing and showing, a frame after the other.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/view/error_map.h"
#include "app/view/navigator.h"
#include "app/view/options.h"
#include "app/view/pacer.h"
#include "app/view/panel.h"
#include "app/view/panel_layer.h"
#include "app/view/picture.h"
#include "app/view/recent_files.h"
#include "app/view/scene_loader.h"
#include "app/view/script.h"
#include "app/view/view_statistics.h"
#include "app/view/window.h"
#include "vk/fullscreen_pass.h"
#include "vk/swapchain.h"

namespace trisect::view {

// When a file of the folder was last written.
std::filesystem::file_time_type last_change(const std::filesystem::path& folder);

class Viewer {
 public:
  // The window, the instance and the device must outlive the viewer.
  Viewer(const ViewOptions& options, std::vector<ScriptStep> script, Window& window,
         const gpu::Instance& instance, const gpu::Device& device, VkSurfaceKHR surface);
  // The last frame reads what is destroyed.
  ~Viewer() { swapchain_.finish(); }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;
  Viewer(Viewer&&) = delete;
  Viewer& operator=(Viewer&&) = delete;

  // Until the window is closed or the options say that it ends. Throws InputError if the first
  // model cannot be loaded or a file that the command line names cannot be written; DeviceError;
  // Interrupted.
  void run();

  [[nodiscard]] const ViewStatistics& statistics() const { return statistics_; }

 private:
  using Clock = std::chrono::steady_clock;

  // What a traced frame shows. A frame of another one is out of date.
  struct Shown {
    RenderOptions render;
    uint64_t scene = 0;  // number of the scene that was loaded, and of the shaders
    uint64_t code = 0;
    KernelChoice kernels;
    uint32_t width = 0;  // of the window
    uint32_t height = 0;

    bool operator==(const Shown&) const = default;
  };

  // Of a loop, in this order.
  [[nodiscard]] double seconds_to_wait() const;
  void take_input();
  void follow_script();
  void take_loaded();
  void move_camera();
  void build_panel_and_obey();
  void trace();
  void show();

  void press(int key, int mods);
  void open(const std::string& model);
  void finish_loading();
  void load();
  void frame_model();
  void frame_now();
  void release_cursor();
  void copy_flags();
  void paste(const std::string& flags);
  void paste_clipboard();
  void save(const std::string& file);
  void save_next();
  std::string next_file();
  void reload_shaders();
  void watch_shaders();
  void measure_error();
  void start_measurement();
  void show_errors();
  void count_work();
  void complain(const std::string& message);
  void entitle();

  [[nodiscard]] bool is_held(int key) const;
  [[nodiscard]] glm::dvec3 steps() const;  // as Motion has them, by the keys that are held
  [[nodiscard]] bool is_walking() const;
  [[nodiscard]] bool shows_errors() const;
  [[nodiscard]] RenderOptions render_now() const;
  [[nodiscard]] RenderOptions render_at(uint32_t width, uint32_t height) const;
  [[nodiscard]] KernelChoice kernels_wanted(uint32_t width, uint32_t height) const;
  Picture& picture_for(const Shown& shown, double scale);
  [[nodiscard]] Shown shown_now() const;
  [[nodiscard]] uint32_t samples_when_still() const;
  // False if input came meanwhile: there is no new frame then. Not while it moves.
  bool trace_at(Picture& picture, uint32_t width, uint32_t height, bool moving);
  void trace_moving(const Shown& now);
  [[nodiscard]] ScreenPush screen_push() const;
  [[nodiscard]] double since_start() const;

  ViewOptions options_;
  Window& window_;
  const gpu::Device& device_;
  gpu::Swapchain swapchain_;
  gpu::FullscreenPass pass_;
  PanelLayer layer_;
  // Of the window's size and more; and of fewer pixels, if those go by another way.
  Picture still_;
  Picture moving_;
  Picture* front_ = &still_;             // what is shown
  gpu::Buffer unused_;                   // for a binding that has nothing
  std::optional<gpu::Texture> texture_;  // of frames no larger than the window
  bool keeps_ = false;                   // the window has nothing new to show
  bool copied_ = false;                  // the frame is in it

  Settings settings_;
  Facts facts_;
  RecentFiles recent_;
  Navigator navigator_;
  Pacer pacer_;
  SceneLoader loader_;
  std::optional<ViewedScene> scene_;
  bool frames_model_ = true;  // the camera is to frame the model that is loaded next
  std::shared_ptr<const KernelCode> code_;
  uint64_t scene_number_ = 0;
  uint64_t code_number_ = 0;
  std::filesystem::file_time_type shaders_changed_;
  Clock::time_point watched_;

  std::optional<Shown> traced_;
  std::optional<Shown> failed_;  // could not be traced
  uint32_t side_ = 0;  // of the frame's pixels in one of the window; 0: less than the window's
  Clock::time_point changed_ = Clock::now();
  Clock::time_point last_loop_ = Clock::now();
  double trace_ms_ = 0.0;  // of this loop
  bool moved_ = false;
  bool warming_ = false;
  int redraws_ = 3;        // ImGui takes some frames to settle
  bool turning_ = false;   // the mouse has the camera
  bool may_turn_ = false;  // it would if its button were pressed
  glm::dvec2 cursor_{0.0};
  double wheel_ = 0.0;

  ErrorMeasurement error_;
  std::optional<gpu::Buffer> error_buffer_;
  ErrorMap error_map_;
  Shown error_of_;

  std::vector<ScriptStep> script_;
  std::size_t next_step_ = 0;
  std::vector<std::pair<int, double>> held_;  // keys and until when
  std::optional<Clock::time_point> first_frame_;
  uint64_t saved_ = 0;
  bool quits_ = false;
  ViewStatistics statistics_;
};

}  // namespace trisect::view
