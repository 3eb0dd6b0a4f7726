// What the commands that compare frames print and write.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "app/base/atomic_file.h"
#include "app/crosscheck/tolerance.h"
#include "app/frame/frame.h"
#include "app/picture/image_file.h"

namespace trisect {

// Compares, and prints the figures under the frames' names. Returns them: "a", "b", the figures,
// and under "excesses" what exceeds the tolerance. Throws InputError if the sizes differ.
nlohmann::ordered_json report_pair(const std::string& name_a, const Frame& a,
                                   const std::string& name_b, const Frame& b,
                                   const Tolerance& tolerance);

// The files of --json and --diff, of which either may be empty: not asked for. Made before the work
// and written after it.
class ComparisonFiles {
 public:
  // Throws InputError or UsageError, naming the file.
  ComparisonFiles(const std::string& json, const std::string& diff);

  // diff: comparison_picture(a, b).
  void write(const nlohmann::ordered_json& json, const Frame& a, const Frame& b);

 private:
  std::optional<ImageFormat> format_;  // of diff
  std::optional<AtomicFile> json_;
  std::optional<AtomicFile> diff_;
};

}  // namespace trisect
