#include "app/cli/sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/base/error.h"
#include "app/base/read_file.h"
#include "app/picture/image_reader.h"
#include "app/picture/stitch.h"

namespace trisect {
namespace {

constexpr const char* kFrame = "{frame}";

std::string with_frame(const std::string& name, const std::string& number) {
  std::string replaced = name;
  for (std::size_t at = 0; (at = replaced.find(kFrame, at)) != std::string::npos;) {
    replaced.replace(at, std::string(kFrame).size(), number);
    at += number.size();
  }
  return replaced;
}

std::optional<CameraPath> path_of(const RenderOptions& options) {
  if (options.turntable && !options.camera_path.empty()) {
    throw UsageError("--turntable and --camera-path: the camera takes one of them.");
  }
  if (options.turntable) return CameraPath::turntable(*options.turntable);
  if (options.camera_path.empty()) return std::nullopt;
  return CameraPath::from_json(read_file(options.camera_path), options.camera_path);
}

void expect_frame(const std::string& option, const std::string& name) {
  if (name.empty() || name.find(kFrame) != std::string::npos) return;
  throw UsageError(
      fmt::format("{}: {} has no {{frame}}, where the number of one of several frames "
                  "is to be.",
                  option, name));
}

}  // namespace

Sequence::Sequence(const RenderOptions& options) : path_(path_of(options)) {
  if (!path_) {
    if (options.frames) throw UsageError("--frames: without --turntable or --camera-path.");
    if (options.resume) throw UsageError("--resume: without --turntable or --camera-path.");
    shots_.push_back({std::nullopt, options.output, options.stats});
    return;
  }
  if (options.runs) throw UsageError("--runs: one frame is timed, not those of a sequence.");
  expect_frame("--output", options.output);
  expect_frame("--stats", options.stats);
  const uint32_t last = path_->frames() - 1;
  const FrameRange range = options.frames.value_or(FrameRange{0, last});
  if (range.last > last) {
    throw UsageError(fmt::format("--frames: the last frame is {}, not {}.", last, range.last));
  }
  const std::size_t digits = std::max<std::size_t>(4, std::to_string(last).size());
  for (uint32_t frame = range.first; frame <= range.last; ++frame) {
    const std::string number = fmt::format("{:0{}}", frame, digits);
    shots_.push_back(
        {frame, with_frame(options.output, number), with_frame(options.stats, number)});
  }
}

bool is_finished(const Shot& shot, const std::vector<ImageAttribute>& attributes) {
  std::error_code error;
  const auto is_there = [&](const std::string& file) {
    return file.empty() || std::filesystem::exists(file, error);
  };
  if (!is_there(shot.image) || !is_there(shot.stats)) return false;
  if (image_format(shot.image) == ImageFormat::pfm) return true;
  if (!is_whole_image(shot.image)) return false;
  const std::string name = difference_between(read_attributes(shot.image), texts_of(attributes));
  if (name.empty()) return true;
  throw InputError(fmt::format(
      "{}: is there already, with another {}; without --resume it is replaced.", shot.image, name));
}

}  // namespace trisect
