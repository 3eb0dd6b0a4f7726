#include "app/view/view_statistics.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/cli/json_text.h"
#include "app/cli/statistics.h"

namespace trisect::view {

std::string to_text(const ViewStatistics& statistics) {
  if (statistics.frames == 0) return {};
  std::string text = fmt::format("{} frames", statistics.frames);
  if (!statistics.moving_ms.empty()) {
    text += fmt::format(
        "; moving: {} of them, {:.1f} ms a frame, {:.0f}% of the window's pixels (medians)",
        statistics.moving_ms.size(), spread_of(statistics.moving_ms).median,
        100.0 * spread_of(statistics.moving_part).median);
  }
  return text + "\n";
}

std::string to_json(const ViewStatistics& statistics) {
  nlohmann::ordered_json json{{"device", statistics.device},
                              {"driver", statistics.driver},
                              {"frames", statistics.frames},
                              {"moving_frames", statistics.moving_ms.size()}};
  if (!statistics.moving_ms.empty()) {
    json["moving_ms"] = json_of(spread_of(statistics.moving_ms));
    json["moving_part"] = json_of(spread_of(statistics.moving_part));
  }
  return json_text(json);
}

}  // namespace trisect::view
