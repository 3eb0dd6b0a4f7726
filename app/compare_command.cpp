#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/atomic_file.h"
#include "app/commands.h"
#include "app/difference_file.h"
#include "app/error.h"
#include "app/frame_comparison.h"
#include "app/image_reader.h"

namespace trisect {

int compare_images(const CompareOptions& options) {
  const Frame a = read_image(options.a);
  const Frame b = read_image(options.b);
  const FrameComparison comparison = compare(a, b);
  const std::vector<std::string> found = excesses(comparison, options.tolerance);
  fmt::print("{} | {}\n{}", options.a, options.b, to_text(comparison));
  for (const std::string& excess : found) fmt::print("  too far apart: {}\n", excess);

  std::optional<AtomicFile> file;
  if (!options.json.empty()) {
    nlohmann::ordered_json json{{"a", options.a}, {"b", options.b}};
    json.update(to_json(comparison));
    json["excesses"] = found;
    file.emplace(options.json);
    file->write(json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  }
  if (!options.diff.empty()) write_difference(a, b, options.diff);
  if (file) file->commit();
  return found.empty() ? exit_done : exit_different;
}

}  // namespace trisect
