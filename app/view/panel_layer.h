// Dear ImGui in the window: context, input, drawing.
#pragma once

#include "app/view/window.h"
#include "vk/device.h"
#include "vk/owned.h"

namespace trisect::view {

// There can be one at a time, as Dear ImGui's context is global. Of the main thread only.
class PanelLayer {
 public:
  // Installs Dear ImGui's callbacks, which call the window's own. Throws DeviceError.
  PanelLayer(const gpu::Instance& instance, const gpu::Device& device, const Window& window,
             VkRenderPass render_pass);
  ~PanelLayer();
  PanelLayer(const PanelLayer&) = delete;
  PanelLayer& operator=(const PanelLayer&) = delete;
  PanelLayer(PanelLayer&&) = delete;
  PanelLayer& operator=(PanelLayer&&) = delete;

  // The panel is laid out between these.
  static void begin();
  static void end();

  // Records the drawing of the panel, within the render pass.
  static void draw(VkCommandBuffer commands);

  // Whether the panel takes the keys, because text is typed into it, or the mouse.
  [[nodiscard]] static bool wants_keys();
  [[nodiscard]] static bool wants_mouse();

 private:
  // All but ImGui's part in Vulkan. If that fails, the destructor cleans up.
  PanelLayer(const gpu::Device& device, const Window& window);

  gpu::Owned<VkDescriptorPool, vkDestroyDescriptorPool> pool_;
};

}  // namespace trisect::view
