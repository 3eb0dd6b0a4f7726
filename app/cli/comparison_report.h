// What the commands that compare frames print and write.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "app/cli/output.h"
#include "app/crosscheck/tolerance.h"
#include "app/frame/frame.h"
#include "app/picture/image_file.h"

namespace trisect {

// Compares two frames and prints the figures under the frames' names. Returns an object with the
// names as "a" and "b", the figures, and under "excesses" what exceeds the tolerance. Throws
// InputError if the sizes differ.
nlohmann::ordered_json report_pair(const std::string& name_a, const Frame& a,
                                   const std::string& name_b, const Frame& b,
                                   const Tolerance& tolerance);

// Prints that a figure is too large, and adds it to the "excesses" of report_pair().
void add_excess(const std::string& excess, nlohmann::ordered_json& figures);

// The files of --json and --diff; an empty path means that the file is not asked for. They are
// opened before the frames are made, so that a path that cannot be written is reported at once.
class ComparisonFiles {
 public:
  // Throws InputError or UsageError, naming the file.
  ComparisonFiles(const std::string& json, const std::string& diff);

  // Writes `json`, and comparison_picture(a, b) to the file of --diff.
  void write(const nlohmann::ordered_json& json, const Frame& a, const Frame& b);

 private:
  std::string name_;                   // of diff
  std::optional<ImageFormat> format_;  // the same
  OptionalOutput json_;
  std::optional<Output> diff_;
};

}  // namespace trisect
