// The errors that a user can cause, each one clear sentence. ExitCode: what the program ends with.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>

#include "vk/error.h"

namespace trisect {

enum ExitCode : int {
  exit_done = 0,
  exit_different = 1,  // from what was promised
  exit_usage = 2,
  exit_bad_input = 3,
  exit_no_device = 4,
  exit_device_lost = 5,
  exit_out_of_memory = 6,  // of the device or of the machine
  exit_internal = 70,      // a failed check of the program's own, as sysexits.h has it
  exit_interrupted = 130,
};

// The command line asks for something that is not there. The message names the option.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A file cannot be read or written, or holds nonsense. The message names the file and, where there
// is one, the line.
class InputError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A graphics device that is not there, or that cannot do what is asked of it: Vulkan's or OpenGL's.
using DeviceError = gpu::Error;
using NoDevice = gpu::NoDevice;
using DeviceLost = gpu::DeviceLost;
// Also the machine's memory, for libraries that do not throw std::bad_alloc.
using OutOfMemory = gpu::OutOfMemory;

inline bool is_lack_of_memory(const std::exception& error) {
  return dynamic_cast<const OutOfMemory*>(&error) != nullptr ||
         dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
}

// Whether an error is told as it is by whoever makes one of its own of what a library throws.
inline bool is_told_as_it_is(const std::exception& error) {
  return dynamic_cast<const UsageError*>(&error) != nullptr ||
         dynamic_cast<const InputError*>(&error) != nullptr || is_lack_of_memory(error);
}

inline constexpr const char* kNoMemory = "not enough memory for this model and image size.";

}  // namespace trisect
