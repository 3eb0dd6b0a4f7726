// The panel with the settings of the view, and the list of keys.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/options.h"

namespace trisect::view {

// What the user sets in the panel or by keys.
struct Settings {
  // width and height are those of saved pictures; spp is that of saved pictures and of the window
  // at rest.
  RenderOptions render;
  uint shown = SHOWN_COLOR;
  double frame_ms = 33.0;  // time that a frame may take while something moves
  bool counts = false;     // count evaluations and candidates
  bool orbit = false;      // the camera orbits around its target; otherwise it walks
  bool exr = false;        // save pictures as EXR; otherwise as PNG
  bool panel = true;       // show the panel
  bool show_keys = false;  // show the list of keys
};

// What the user asked for in the panel.
struct Requests {
  bool save = false;
  bool copy = false;
  bool paste = false;
  bool reload_shaders = false;
  bool measure_error = false;
  bool frame_model = false;
  std::optional<std::string> open;  // a model
};

// Means per pixel.
struct Work {
  double evaluations = 0.0;
  double candidates = 0.0;
};

// What the panel shows.
struct Facts {
  std::string device;
  std::string driver;
  bool ray_query = false;  // the device has ray queries
  std::string model;       // about the model, one line
  std::string message;     // what was done last, or why it failed
  bool loading = false;
  bool making_kernels = false;
  std::vector<std::string> models;  // files to choose from
  std::vector<std::string> recent;  // files that were opened last
  std::vector<float> frame_ms;      // of the last moving frames
  double trace_ms = 0.0;            // of the last frame, as its size and acceleration
  uint32_t frame_width = 0;
  uint32_t frame_height = 0;
  std::string accel;
  std::optional<Work> work;
  std::optional<float> error_progress;
  std::string error;      // about the measured error, one line
  std::string save_file;  // the name of the next picture
};

// Lays out the panel and the list of keys between PanelLayer's begin() and end(), and changes the
// settings as the user does.
Requests build_panel(Settings& settings, const Facts& facts);

// The output (SHOWN_...) of that name in the panel; nothing if there is none.
std::optional<uint> shown_named(const std::string& name);

}  // namespace trisect::view
