// What the window is to show: settings, model, camera and kernels, and the frame that follows.
#pragma once

#include <cstdint>

#include "app/view/camera_control.h"
#include "app/view/frame_content.h"
#include "app/view/kernel_source.h"
#include "app/view/loaded_model.h"
#include "app/view/options.h"
#include "app/view/panel.h"
#include "vk/device.h"

namespace trisect::view {

// The functions need the model to be loaded. Sizes are in pixels.
struct ViewState {
  ViewState(const ViewOptions& options, const gpu::Device& device);

  // What `trisect render` would need to render the same view: the options of the panel, with the
  // camera of the window and the model that is loaded.
  [[nodiscard]] RenderOptions render_options() const;

  // The same, of this size and one ray per pixel.
  [[nodiscard]] RenderOptions render_options(uint32_t width, uint32_t height) const;

  // Kernels for a frame of this size that has the outputs that are shown.
  [[nodiscard]] KernelChoice kernel_choice(uint32_t width, uint32_t height) const;

  // What a window of this size shows now.
  [[nodiscard]] FrameContent content(uint32_t width, uint32_t height) const;

  // Sets the camera to the eye and target of the settings, or, where they leave them open, so that
  // the model fills a window of this size.
  void frame_model(uint32_t width, uint32_t height);

  Settings settings;
  Facts facts;
  LoadedModel model;
  CameraControl camera;
  KernelSource kernels;

 private:
  bool has_subgroups_;  // the device has their operations
};

}  // namespace trisect::view
