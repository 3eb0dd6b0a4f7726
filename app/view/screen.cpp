#include "app/view/screen.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "app/buffers/kernels.h"
#include "vk/shader_code.h"

namespace trisect::view {
namespace {

std::vector<gpu::ShaderCode> shaders_by_way() {
  std::vector<gpu::ShaderCode> shaders;
  for (uint way = 0; way < SCREEN_WAYS; ++way) {
    shaders.push_back(gpu::specialized(spirv_of("screen_frag"), {{CONSTANT_SCREEN, way}}));
  }
  return shaders;
}

uint way_of(const ScreenPush& push) {
  if (push.shown != SHOWN_COLOR) return SCREEN_OUTPUT;
  if (push.frame_width == push.width) return SCREEN_PIXEL;
  return push.frame_width < 2 * push.width ? SCREEN_ENLARGED : SCREEN_MEAN;
}

}  // namespace

Screen::Screen(const gpu::Instance& instance, const gpu::Device& device, const Window& window,
               VkSurfaceKHR surface)
    : device_(device),
      swapchain_(device, surface),
      pass_(device, swapchain_.render_pass(), spirv_of("screen_vert"), shaders_by_way(),
            screen_interface(), BINDING_FRAME, "screen"),
      layer_(instance, device, window, swapchain_.render_pass()),
      unused_(device, sizeof(PixelAovs), gpu::Memory::host, "unused") {
  std::fill(unused_.bytes().begin(), unused_.bytes().end(), std::byte{0});
}

bool Screen::show(uint32_t width, uint32_t height, const Picture& picture,
                  const gpu::Buffer* errors, ScreenPush push) {
  swapchain_.wait();
  const gpu::Buffer* colors = picture.is_there() ? &picture.colors() : &unused_;
  const gpu::Buffer* aovs = picture.is_there() ? &picture.aovs() : &unused_;
  if (!texture_ || texture_->width() < width || texture_->height() < height) {
    texture_.emplace(device_, width, height, "frame");
    texture_is_current_ = false;
  }
  pass_.bind({errors != nullptr ? errors : colors, aovs}, *texture_);
  return swapchain_.show(
      width, height,
      [&](VkCommandBuffer commands) {
        if (std::exchange(texture_is_current_, true)) return;
        const bool fits = picture.is_there() && picture.width() <= texture_->width() &&
                          picture.height() <= texture_->height();
        // The copy also brings a new texture into the layout that the pass reads: without a frame
        // that fits, one pixel does.
        texture_->copy(commands, *colors, fits ? picture.width() : 1, fits ? picture.height() : 1);
      },
      [&](VkCommandBuffer commands) {
        // Only now is the swapchain of the window's size.
        push.width = swapchain_.extent().width;
        push.height = swapchain_.extent().height;
        pass_.draw(commands, way_of(push), std::as_bytes(std::span(&push, 1)));
        PanelLayer::draw(commands);
      });
}

}  // namespace trisect::view
