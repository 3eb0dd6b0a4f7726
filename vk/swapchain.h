// The images of a window: acquired, drawn into, shown.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "vk/command_buffer.h"
#include "vk/device.h"
#include "vk/owned.h"

namespace trisect::gpu {

// A swapchain with a render pass whose one attachment is its image, 8 bits a component without
// encoding: what is drawn is shown as it is. One frame is in flight: the host waits for the last
// one before it draws the next.
class Swapchain {
 public:
  using Recorder = std::function<void(VkCommandBuffer)>;

  // The device must have been made for the surface, and both must outlive the swapchain. Throws
  // Error.
  Swapchain(const Device& device, VkSurfaceKHR surface);
  ~Swapchain() { finish(); }
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;
  Swapchain(Swapchain&&) = delete;
  Swapchain& operator=(Swapchain&&) = delete;

  [[nodiscard]] VkRenderPass render_pass() const { return render_pass_.get(); }
  [[nodiscard]] VkExtent2D extent() const { return extent_; }

  // Draws and shows a frame: `prepare` records into the command buffer before the render pass,
  // `draw` within it; the compute shaders' writes before it are visible to its fragment shaders.
  // width, height: the window's size in pixels; where the surface does not say its own, the images
  // get it. Returns whether a frame was shown: none is while the window has no size, and one may be
  // lost while that changes. Throws Error.
  bool show(uint32_t width, uint32_t height, const Recorder& prepare, const Recorder& draw);

  // Until the last frame is drawn: what it read may be written again.
  void wait();

  // Until nothing that was drawn or shown is in use by the device any more.
  void finish() noexcept;

  // Makes the next frame begin with new images, as after a change of the window's size.
  void outdate() { current_ = false; }

 private:
  struct Image {
    Owned<VkImageView, vkDestroyImageView> view;
    Owned<VkFramebuffer, vkDestroyFramebuffer> framebuffer;
    Owned<VkSemaphore, vkDestroySemaphore> drawn;
  };

  // New images of the surface's size; false if it has none.
  bool renew(uint32_t width, uint32_t height);
  void record(const Image& image, const Recorder& prepare, const Recorder& draw);

  const Device* device_;
  VkSurfaceKHR surface_;
  VkSurfaceFormatKHR format_{};
  VkExtent2D extent_{};
  bool current_ = false;  // images_ fit the surface
  Owned<VkRenderPass, vkDestroyRenderPass> render_pass_;
  Owned<VkSwapchainKHR, vkDestroySwapchainKHR> swapchain_;
  std::vector<Image> images_;
  CommandBuffer commands_;
  Owned<VkSemaphore, vkDestroySemaphore> acquired_;
  Owned<VkFence, vkDestroyFence> done_;  // signalled when no frame is in flight
};

}  // namespace trisect::gpu
