// The frames of `trisect render` and their files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/camera_path.h"
#include "app/cli/options.h"

namespace trisect {

// A frame that is to be rendered.
struct Shot {
  std::optional<uint32_t> frame;  // of a path
  std::string image;
  std::string stats;  // empty: not wanted
};

// One frame, or several along a path of the camera.
class Sequence {
 public:
  // Throws UsageError for options that do not go together, InputError for a path's file that cannot
  // be read.
  explicit Sequence(const RenderOptions& options);

  // The frames to be rendered, in order, with {frame} in the files' names replaced by the frame's
  // number, four digits or as many as the last one needs.
  [[nodiscard]] const std::vector<Shot>& shots() const { return shots_; }

  // Whether there is a path, although perhaps of one frame only.
  [[nodiscard]] bool is_path() const { return path_.has_value(); }

  // The camera of a frame; start: without the path.
  [[nodiscard]] Camera camera(const Shot& shot, const Camera& start) const {
    return path_ ? path_->at(*shot.frame, start) : start;
  }

 private:
  std::optional<CameraPath> path_;
  std::vector<Shot> shots_;
};

// Whether a frame's files are there whole, and nothing is left to do. attributes: those that the
// image is to have. Throws InputError if the image is another: of another model, view or setting.
// Who made it, and on what device, does not count; a PFM does not say what it is.
bool is_finished(const Shot& shot, const std::vector<ImageAttribute>& attributes);

}  // namespace trisect
