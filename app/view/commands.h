// The command `trisect view`.
#pragma once

#include "app/view/options.h"

namespace trisect {

// Shows a model in a window until that is closed; returns an exit code.
int view_model(const ViewOptions& options);

}  // namespace trisect
