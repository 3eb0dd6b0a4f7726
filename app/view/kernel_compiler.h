// Kernels compiled from their sources while the program runs, for those who edit them.
#pragma once

#include <filesystem>

#include "app/buffers/kernel_code.h"

namespace trisect::view {

// Compiles the kernels that make a frame from the sources in `folder`, as the build does but
// without its check of the SPIR-V. Throws InputError with the compiler's first message - file, line
// and what is wrong - if one does not compile or cannot be read.
KernelCode compile_kernels(const std::filesystem::path& folder);

}  // namespace trisect::view
