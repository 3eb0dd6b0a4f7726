// Dear ImGui in the window: its context, its input, its drawing.
#pragma once

#include "app/view/window.h"
#include "vk/device.h"
#include "vk/owned.h"

namespace trisect::view {

class PanelLayer {
 public:
  // The window's own callbacks stay: this one's call them. Throws DeviceError.
  PanelLayer(const gpu::Instance& instance, const gpu::Device& device, const Window& window,
             VkRenderPass render_pass);
  ~PanelLayer();
  PanelLayer(const PanelLayer&) = delete;
  PanelLayer& operator=(const PanelLayer&) = delete;
  PanelLayer(PanelLayer&&) = delete;
  PanelLayer& operator=(PanelLayer&&) = delete;

  // Between these the panel is built.
  static void begin();
  static void end();

  // Within the render pass.
  static void draw(VkCommandBuffer commands);

  // Whether keys or the mouse are the panel's now.
  [[nodiscard]] static bool wants_keys();
  [[nodiscard]] static bool wants_mouse();

 private:
  gpu::Owned<VkDescriptorPool, vkDestroyDescriptorPool> pool_;
};

}  // namespace trisect::view
