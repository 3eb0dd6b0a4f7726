// The panel: what is shown and how, and what is known of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/options.h"

namespace trisect::view {

// What the panel changes.
struct Settings {
  // width, height and spp of it are those of saved pictures; spp is the window's, too, when it is
  // still.
  RenderOptions render;
  uint shown = SHOWN_COLOR;
  double frame_ms = 33.0;  // that a frame may take while something moves
  bool counts = false;     // evaluations and candidates are counted and told
  bool orbit = false;
  bool exr = false;        // pictures are saved as EXR; as PNG without it
  bool panel = true;       // is there
  bool show_keys = false;  // the list of keys is there
};

// What it asks for.
struct Requests {
  bool save = false;
  bool copy = false;
  bool paste = false;
  bool reload_shaders = false;
  bool measure_error = false;
  bool frame_model = false;
  std::optional<std::string> open;  // a model
};

struct Work {
  double evaluations = 0.0;  // a pixel
  double candidates = 0.0;
};

// What it shows.
struct Facts {
  std::string device;
  std::string driver;
  bool ray_query = false;  // of the device
  std::string model;       // in a line
  std::string message;     // the last one; what failed, or what was done
  bool loading = false;
  std::vector<std::string> models;  // to choose from
  std::vector<std::string> recent;
  std::vector<float> frame_ms;  // of the last frames
  double trace_ms = 0.0;        // of the last frame
  uint32_t frame_width = 0;
  uint32_t frame_height = 0;
  std::string accel;
  std::optional<Work> work;
  std::optional<float> error_progress;
  std::string error;  // in a line
  std::string save_file;
};

// Builds the panel, within PanelLayer's begin and end, and changes the settings.
Requests build_panel(Settings& settings, const Facts& facts);

// The output of that name, as the panel has it; nothing if there is none.
std::optional<uint> shown_named(const std::string& name);

}  // namespace trisect::view
