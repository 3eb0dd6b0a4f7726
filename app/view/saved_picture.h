// Pictures that are kept: of any size, whatever the window's.
#pragma once

#include <string>

#include "app/bake/bake.h"
#include "app/cli/options.h"
#include "app/mesh/mesh.h"
#include "vk/device.h"

namespace trisect::view {

// Renders what `trisect render` would with these options, bit for bit, and writes it to the file, a
// .png or .exr. Throws UsageError, InputError or DeviceError, and leaves no file then.
void save_picture(const gpu::Device& device, const Mesh& mesh, const BakedScene& scene,
                  const RenderOptions& options, const std::string& file);

}  // namespace trisect::view
