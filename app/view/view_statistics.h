// How fast a window was.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trisect::view {

struct ViewStatistics {
  std::string device;
  std::string driver;
  uint64_t frames = 0;  // that were shown
  // Of frames that were traced anew because something had changed:
  std::vector<double> moving_ms;    // from the look at the input until the frame is handed over
  std::vector<double> moving_part;  // their pixels over the window's
};

// A line for a person; empty if nothing was shown.
std::string to_text(const ViewStatistics& statistics);

std::string to_json(const ViewStatistics& statistics);

}  // namespace trisect::view
