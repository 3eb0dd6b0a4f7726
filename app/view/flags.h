// The options of `trisect render` as text, to be copied and pasted.
#pragma once

#include <string>

#include "app/cli/options.h"

namespace trisect::view {

// What `options` render, but for the model, the files, the device and who traces: what is not said
// is as in `trisect render` by default. Numbers are as short as they can be and still read back to
// the same value, so that the text gives the same image bit for bit.
std::string flags_of(const RenderOptions& options);

// The options in `text`, which may begin with "trisect render" and have a MODEL and -o FILE (all
// ignored), laid over `base`. Words are parted by white space. Without --shadows, --spp and --accel
// there are no shadows, one ray a pixel and accel auto; of the others those not given are `base`'s.
// Throws UsageError, naming what is wrong, for anything that is not of add_view or --spp and for
// what `trisect render` would not take.
RenderOptions with_flags(const RenderOptions& base, const std::string& text);

}  // namespace trisect::view
