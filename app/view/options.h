// The parsed options of `trisect view`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/cli/options.h"

namespace trisect {

struct ViewOptions {
  // width and height are also those of the window when it opens. output, runs and stats are unused.
  RenderOptions render;
  std::string assets;              // folder of the models that the panel offers
  std::string shaders;             // folder of the shaders' sources
  bool watch = false;              // compile the shaders whenever a source changes
  double frame_ms = 33.0;          // time that a frame may take while something moves
  std::optional<uint64_t> frames;  // end after this many frames
  std::string screenshot;          // file to write at the end; empty: none
  std::string script;              // file of a script; empty: none
  std::string stats;               // file for the statistics; empty: none
};

}  // namespace trisect
