#include <filesystem>
#include <vector>

#include "app/base/error.h"
#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "app/picture/image_file.h"
#include "app/picture/stitch.h"

namespace trisect {

int stitch_parts(const StitchOptions& options) {
  begin_outputs(options.parts, {options.output});
  const ImageFormat format = output_format(options.output);
  Output output(options.output);
  stitch({options.parts.begin(), options.parts.end()}, format, output.file());
  output.commit();
  say("{}: {} parts\n", options.output, options.parts.size());
  return exit_done;
}

}  // namespace trisect
