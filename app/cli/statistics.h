// The statistics of a render, as text for people and as JSON for programs.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/bake/bake.h"
#include "app/cli/options.h"
#include "app/cli/picture_source.h"
#include "app/frame/frame.h"
#include "app/frame/frame_time.h"

namespace trisect {

// Smallest, middle and largest of one or more numbers; the middle of an even count is the mean of
// two.
struct Spread {
  double min = 0.0;
  double median = 0.0;
  double max = 0.0;
};

Spread spread_of(std::vector<double> values);

// Its members under their names.
nlohmann::ordered_json json_of(const Spread& spread);

// Work, summed over all pixels.
struct WorkCounts {
  uint64_t evaluations = 0;  // of the field (bisect) or of the surface with derivatives (robust)
  uint64_t candidates = 0;   // triangles or subpatches whose bounds a pixel's ray meets
  // Bytes of the scene that the traversal loads. A load that several rays share, or that a cache
  // serves, counts once for each ray. 0 if it is not counted.
  uint64_t bytes_read = 0;
  // Rays that a Vulkan kernel left to a later one.
  uint64_t queued_rays = 0;
};

// Of a frame with AOVs; 0 if nothing was counted.
WorkCounts work_of(const Frame& frame);

struct RenderStatistics {
  PictureSource source;
  std::size_t patches = 0;
  std::optional<uint32_t> frame;  // of a sequence
  std::size_t hits = 0;
  std::size_t scene_bytes = 0;       // on the device: triangles, subpatch bounds, tree
  std::optional<WorkCounts> counts;  // with --evals
  std::vector<FrameTime> frames;     // the timed runs
  double load_ms = 0.0;
  double bake_ms = 0.0;
  std::optional<double> bvh_ms;  // if a tree was built
  double upload_ms = 0.0;
};

// The statistics as JSON, with the keys that README lists.
std::string to_json(const RenderOptions& options, const RenderStatistics& statistics);

// A few lines for a person.
std::string to_text(const RenderOptions& options, const RenderStatistics& statistics);

}  // namespace trisect
