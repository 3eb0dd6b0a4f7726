// Everything that decides what a frame in the window looks like.
#pragma once

#include <cstdint>

#include "app/buffers/kernel_choice.h"
#include "app/cli/options.h"

namespace trisect::view {

// Two frames of equal content are the same picture, up to resolution and samples per pixel. A frame
// whose content differs from what is wanted now is out of date.
struct FrameContent {
  RenderOptions render;  // with the camera of the frame; width and height are 0 and spp is 1
  uint64_t scene = 0;    // number of the loaded scene: each one that is loaded gets the next
  uint64_t code = 0;     // number of the compiled shaders: 0 for the built-in ones
  KernelChoice kernels;  // for a frame of the window's size
  uint32_t width = 0;    // of the window, in pixels
  uint32_t height = 0;

  bool operator==(const FrameContent&) const = default;
};

}  // namespace trisect::view
