// The exceptions of the Vulkan layer. Outside of it they are called DeviceError and NoDevice
// (app/base/error.h).
#pragma once

#include <stdexcept>

namespace trisect::gpu {

// A Vulkan call failed, or the device cannot do what is asked of it.
class Error : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// There is no usable device. If there are devices, the message lists each one with what it lacks.
class NoDevice : public Error {
  using Error::Error;
};

}  // namespace trisect::gpu
