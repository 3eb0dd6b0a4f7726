#include <nlohmann/json.hpp>

#include "app/base/error.h"
#include "app/cli/commands.h"
#include "app/cli/comparison_report.h"
#include "app/cli/output.h"
#include "app/picture/image_reader.h"

namespace trisect {

int compare_images(const CompareOptions& options) {
  begin_outputs({options.a, options.b}, {options.json, options.diff});
  const Frame a = read_image(options.a);
  const Frame b = read_image(options.b);
  ComparisonFiles files(options.json, options.diff);
  const nlohmann::ordered_json figures = report_pair(options.a, a, options.b, b, options.tolerance);
  files.write(figures, a, b);
  return figures["excesses"].empty() ? exit_done : exit_different;
}

}  // namespace trisect
