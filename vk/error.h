// The exceptions of the Vulkan layer. Outside of it Error is called DeviceError (app/base/error.h).
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

// The device was lost: its driver gave its work up. Nothing more can be done with it than to
// destroy it and what it made.
class DeviceLost : public Error {
  using Error::Error;
};

// There is not enough memory, of the device or of the machine. What was there before still is.
class OutOfMemory : public Error {
  using Error::Error;
};

}  // namespace trisect::gpu
