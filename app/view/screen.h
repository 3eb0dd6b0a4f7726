// Draws into the window: the frame or one of its outputs, and the panel over it.
#pragma once

#include <cstdint>
#include <optional>

#include "app/surface/shared.h"
#include "app/view/panel_layer.h"
#include "app/view/picture.h"
#include "app/view/window.h"
#include "vk/buffer.h"
#include "vk/fullscreen_pass.h"
#include "vk/swapchain.h"
#include "vk/texture.h"

namespace trisect::view {

// Not thread safe.
class Screen {
 public:
  // The window, the instance, the device and the surface must outlive the screen. Throws
  // DeviceError.
  Screen(const gpu::Instance& instance, const gpu::Device& device, const Window& window,
         VkSurfaceKHR surface);
  // What the last frame reads must outlive finish().
  ~Screen() { finish(); }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;
  Screen(Screen&&) = delete;
  Screen& operator=(Screen&&) = delete;

  // Draws a frame into a window of this size in pixels and shows it. picture: read if it has a
  // frame; errors: the buffer of an error map, shown in place of the picture, or null. Of `push`,
  // width and height are filled in here. Returns whether a frame was shown; see Swapchain::show.
  bool show(uint32_t width, uint32_t height, const Picture& picture, const gpu::Buffer* errors,
            ScreenPush push);

  // The picture holds another frame than at the last show().
  void picture_changed() { texture_is_current_ = false; }

  // The size of the window has changed.
  void resized() { swapchain_.outdate(); }

  // Waits until the last frame is drawn: what it read may be written or destroyed then.
  void wait() { swapchain_.wait(); }

  // Waits until the device uses nothing more of what was drawn or shown.
  void finish() noexcept { swapchain_.finish(); }

 private:
  const gpu::Device& device_;
  gpu::Swapchain swapchain_;
  gpu::FullscreenPass pass_;  // a fragment shader for each SCREEN_...
  PanelLayer layer_;
  gpu::Buffer unused_;  // for the bindings of a picture without a frame
  // The picture's colours for filtered reading, in its upper left corner; of the largest size that
  // the window has had. A frame that is larger is not copied into it.
  std::optional<gpu::Texture> texture_;
  bool texture_is_current_ = false;
};

}  // namespace trisect::view
