#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/cli/commands.h"
#include "app/cli/comparison_report.h"
#include "app/cli/output.h"
#include "app/picture/image_channels.h"
#include "app/picture/image_reader.h"

namespace trisect {
namespace {

// Two files with the same pixels in other places are not the same picture.
void compare_windows(const CompareOptions& options, nlohmann::ordered_json& figures) {
  const std::optional<ImageWindow> a = read_window(options.a);
  const std::optional<ImageWindow> b = read_window(options.b);
  if (a == b) return;
  add_excess(fmt::format("the first is {}, the second {}", window_text(a), window_text(b)),
             figures);
}

// Pixels with other bits, for each channel; of a channel that only one file has, null.
void compare_channels(const CompareOptions& options, nlohmann::ordered_json& figures) {
  const ImageChannels first(options.a);
  const ImageChannels second(options.b);
  const std::vector<std::string>& a = first.names();
  const std::vector<std::string>& b = second.names();
  std::vector<std::string> all;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  for (const std::string& name : all) {
    const bool in_a = std::binary_search(a.begin(), a.end(), name);
    if (!in_a || !std::binary_search(b.begin(), b.end(), name)) {
      figures["channels"][name] = nullptr;
      add_excess(fmt::format("only {} has the channel {}", in_a ? options.a : options.b, name),
                 figures);
      continue;
    }
    const std::vector<uint32_t> one = first.bits(name);
    const std::vector<uint32_t> other = second.bits(name);
    std::size_t differ = 0;
    for (std::size_t i = 0; i < one.size(); ++i) differ += one[i] != other[i] ? 1 : 0;
    figures["channels"][name] = differ;
    if (differ > 0) {
      add_excess(fmt::format("channel {} has other bits in {} pixels", name, differ), figures);
    }
  }
}

}  // namespace

int compare_images(const CompareOptions& options) {
  begin_outputs({options.a, options.b}, {options.json, options.diff});
  if (options.exact && image_format(options.a) != image_format(options.b)) {
    throw UsageError("--exact: both images must be PNG or both EXR.");
  }
  const Frame a = read_image(options.a);
  const Frame b = read_image(options.b);
  ComparisonFiles files(options.json, options.diff);
  nlohmann::ordered_json figures = report_pair(options.a, a, options.b, b, options.tolerance);
  compare_windows(options, figures);
  if (options.exact) compare_channels(options, figures);
  files.write(figures, a, b);
  return figures["excesses"].empty() ? exit_done : exit_different;
}

}  // namespace trisect
