// What goes wrong with a device.
#pragma once

#include <stdexcept>

namespace trisect::gpu {

// A call that did not succeed, or a device that cannot do what is asked of it.
class Error : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// No device fits; the message lists each one and what it lacks.
class NoDevice : public Error {
  using Error::Error;
};

}  // namespace trisect::gpu
