// The command line's values for `trisect view`, parsed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/cli/options.h"

namespace trisect {

struct ViewOptions {
  RenderOptions
      render;          // width and height are the window's; its output, runs and stats mean nothing
  std::string assets;  // folder of the models to choose from
  std::string shaders;             // folder of the shaders' sources
  bool watch = false;              // recompiles them when they change
  double frame_ms = 33.0;          // that a frame may take while something moves
  std::optional<uint64_t> frames;  // ends after so many
  std::string screenshot;          // written at the end
  std::string script;
  std::string stats;
};

}  // namespace trisect
