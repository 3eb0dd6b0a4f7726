// How fast the frames of a window were.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trisect::view {

struct ViewStatistics {
  std::string device;
  std::string driver;
  uint64_t frames = 0;  // frames shown since the model was loaded
  // Of each frame that was traced because what the window shows had changed:
  std::vector<double> moving_ms;    // from taking the input until the frame is given to the display
  std::vector<double> moving_part;  // its pixels over those of the window
};

// One line of text for the terminal; empty if no frame was shown.
std::string to_text(const ViewStatistics& statistics);

std::string to_json(const ViewStatistics& statistics);

}  // namespace trisect::view
