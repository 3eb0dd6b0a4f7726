// The options of `trisect render` as text, to be copied and pasted.
#pragma once

#include <string>

#include "app/cli/options.h"

namespace trisect::view {

// The options as text, except for the model, the files, the device and the back end. What the text
// leaves out has the default value of `trisect render`. Numbers are as short as they can be and
// still read back to the same value, so that the text renders the same image bit for bit.
std::string flags_of(const RenderOptions& options);

// `base` with the options that are given in `text`. Words are separated by white space; "trisect
// render" at the beginning, a MODEL and -o FILE are ignored. Without --shadows, --spp, --accel,
// --shading, --color or --background the result has no shadows, one ray per pixel, accel auto or
// the standard colours, whatever `base` has. Throws UsageError, naming what is wrong, for an option
// that is neither --spp nor one of add_view(), and for values that `trisect render` would refuse.
RenderOptions with_flags(const RenderOptions& base, const std::string& text);

}  // namespace trisect::view
