// The images of a window: acquired, drawn and presented.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "vk/command_buffer.h"
#include "vk/device.h"
#include "vk/owned.h"

namespace trisect::gpu {

// A swapchain with a render pass whose only attachment is the swapchain's image, of 8 bits per
// component in a UNORM format: shaders write colours that are encoded as sRGB already. One frame is
// in flight: show() waits for the last one. For one thread at a time.
class Swapchain {
 public:
  using Recorder = std::function<void(VkCommandBuffer)>;

  // The device must have been made for this surface; both must outlive the swapchain. Throws Error
  // if the surface has no such format.
  Swapchain(const Device& device, VkSurfaceKHR surface);
  ~Swapchain() { finish(); }
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;
  Swapchain(Swapchain&&) = delete;
  Swapchain& operator=(Swapchain&&) = delete;

  [[nodiscard]] VkRenderPass render_pass() const { return render_pass_.get(); }
  [[nodiscard]] VkExtent2D extent() const { return extent_; }

  // Draws and presents a frame. prepare: records commands before the render pass; draw: within it.
  // What compute shaders and copies of earlier submits wrote is visible to the fragment shaders.
  // width, height: the window's size in pixels, which the images get if the surface has no size of
  // its own. Returns whether a frame was presented: not while the window's width or height is 0,
  // and perhaps not while its size changes. Throws Error.
  bool show(uint32_t width, uint32_t height, const Recorder& prepare, const Recorder& draw);

  // Waits until the last frame is drawn: what it reads may then be overwritten.
  void wait();

  // Waits until the device uses nothing of the swapchain any more.
  void finish() noexcept;

  // The window's size has changed: the next frame gets new images.
  void outdate() { current_ = false; }

 private:
  struct Image {
    Owned<VkImageView, vkDestroyImageView> view;
    Owned<VkFramebuffer, vkDestroyFramebuffer> framebuffer;
    Owned<VkSemaphore, vkDestroySemaphore> drawn;
  };

  // Makes new images of the surface's size. Returns false if its width or height is 0.
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
