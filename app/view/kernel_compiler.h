// Compiles kernels from their sources while the program runs, so that a user who edits them sees
// the effect at once.
#pragma once

#include <filesystem>

#include "app/buffers/kernel_code.h"

namespace trisect::view {

// Compiles the kernels with Interface::frame from the sources in `folder`, with the settings of the
// build but without validating the SPIR-V. Throws InputError with the compiler's first message -
// file, line and what is wrong - if one does not compile or cannot be read. Not for several threads
// at the same time.
KernelCode compile_kernels(const std::filesystem::path& folder);

}  // namespace trisect::view
