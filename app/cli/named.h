// Errors that name their file.
#pragma once

#include <string>

#include "app/base/error.h"

namespace trisect {

// Does work on what a file holds, which does not know the file: an InputError gets its name.
template <typename Work>
auto named(const std::string& file, Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(file + ": " + error.what());
  }
}

}  // namespace trisect
