// What this process takes at most.
#pragma once

#include <malloc.h>

#include <fstream>
#include <string>

namespace trisect::test {

// Measures from its construction on. Tests that use it need a process of their own: what was freed
// before may be used again.
class PeakMemory {
 public:
  PeakMemory() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;  // begins the peak anew
    before_ = kilobytes("VmRSS:");
  }

  // Bytes at the peak, less those at the beginning.
  [[nodiscard]] double bytes() const { return 1024.0 * (kilobytes("VmHWM:") - before_); }

 private:
  // Of a line of /proc/self/status.
  static double kilobytes(const std::string& key) {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);) {
      if (line.starts_with(key)) return std::stod(line.substr(key.size() + 1));
    }
    return 0.0;
  }

  double before_ = 0.0;
};

}  // namespace trisect::test
