// Saves the view as an image file, of any size whatever that of the window.
#pragma once

#include <string>

#include "app/cli/options.h"
#include "app/view/loaded_model.h"
#include "vk/device.h"

namespace trisect::view {

// Renders the image that `trisect render` renders with these options, bit for bit, and writes it to
// the file, a .png or .exr. On an error no file is left. Throws UsageError, InputError,
// DeviceError.
void save_picture(const gpu::Device& device, const LoadedModel& model, const RenderOptions& options,
                  const std::string& file);

}  // namespace trisect::view
