#include "vk/swapchain.h"

#include <algorithm>
#include <limits>

#include "vk/result.h"

namespace trisect::gpu {
namespace {

constexpr uint64_t kForever = std::numeric_limits<uint64_t>::max();

// A format without sRGB encoding: the frames' colours are encoded already.
VkSurfaceFormatKHR format_for(const Device& device, VkSurfaceKHR surface) {
  uint32_t count = 0;
  TRISECT_VK(vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical(), surface, &count, nullptr));
  std::vector<VkSurfaceFormatKHR> formats(count);
  TRISECT_VK(
      vkGetPhysicalDeviceSurfaceFormatsKHR(device.physical(), surface, &count, formats.data()));
  for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM}) {
    for (const VkSurfaceFormatKHR& format : formats) {
      if (format.format == wanted) return format;
    }
  }
  throw Error("device " + device.report().name +
              " has no 8-bit format without sRGB encoding for this window");
}

VkCompositeAlphaFlagBitsKHR opaque_or_any(VkCompositeAlphaFlagsKHR supported) {
  constexpr VkCompositeAlphaFlagBitsKHR opaque = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
  return (supported & opaque) != 0 ? opaque : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
}

}  // namespace

Swapchain::Swapchain(const Device& device, VkSurfaceKHR surface)
    : device_(&device), surface_(surface), format_(format_for(device, surface)), commands_(device) {
  const VkDevice handle = device.get();
  VkAttachmentDescription attachment{};
  attachment.format = format_.format;
  attachment.samples = VK_SAMPLE_COUNT_1_BIT;
  // Every pixel is drawn, so nothing needs to be loaded.
  attachment.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  attachment.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  attachment.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
  const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &color;
  // The submit waits for the image's acquisition in the stage of colour output: the transition to
  // the attachment's layout must not happen earlier.
  VkSubpassDependency dependency{};
  dependency.srcSubpass = VK_SUBPASS_EXTERNAL;
  dependency.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  dependency.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  dependency.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  VkRenderPassCreateInfo pass{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
  pass.attachmentCount = 1;
  pass.pAttachments = &attachment;
  pass.subpassCount = 1;
  pass.pSubpasses = &subpass;
  pass.dependencyCount = 1;
  pass.pDependencies = &dependency;
  TRISECT_VK(vkCreateRenderPass(handle, &pass, nullptr, render_pass_.fill(handle)));

  const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
  TRISECT_VK(vkCreateSemaphore(handle, &semaphore, nullptr, acquired_.fill(handle)));
  VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  fence.flags = VK_FENCE_CREATE_SIGNALED_BIT;
  TRISECT_VK(vkCreateFence(handle, &fence, nullptr, done_.fill(handle)));
}

void Swapchain::finish() noexcept {
  // Presentation uses the semaphores until the queue is idle; no fence signals that.
  if (vkQueueWaitIdle(device_->queue()) != VK_SUCCESS) vkDeviceWaitIdle(device_->get());
}

void Swapchain::wait() {
  const VkFence fence = done_.get();
  TRISECT_VK_WAIT(*device_, vkWaitForFences(device_->get(), 1, &fence, VK_TRUE, kForever));
}

bool Swapchain::renew(uint32_t width, uint32_t height) {
  VkSurfaceCapabilitiesKHR capabilities{};
  TRISECT_VK(
      vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_->physical(), surface_, &capabilities));
  VkExtent2D extent = capabilities.currentExtent;
  // The special value says that the images decide the surface's size.
  if (extent.width == std::numeric_limits<uint32_t>::max()) {
    extent = {
        std::clamp(width, capabilities.minImageExtent.width, capabilities.maxImageExtent.width),
        std::clamp(height, capabilities.minImageExtent.height, capabilities.maxImageExtent.height)};
  }
  if (extent.width == 0 || extent.height == 0) return false;
  // The old images must not be in use when they are destroyed.
  TRISECT_VK_WAIT(*device_, vkQueueWaitIdle(device_->queue()));
  images_.clear();

  VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
  info.surface = surface_;
  info.minImageCount = std::max(capabilities.minImageCount, uint32_t{2});
  if (capabilities.maxImageCount > 0) {
    info.minImageCount = std::min(info.minImageCount, capabilities.maxImageCount);
  }
  info.imageFormat = format_.format;
  info.imageColorSpace = format_.colorSpace;
  info.imageExtent = extent;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = capabilities.currentTransform;
  info.compositeAlpha = opaque_or_any(capabilities.supportedCompositeAlpha);
  info.presentMode = VK_PRESENT_MODE_FIFO_KHR;  // the one that every device has
  info.clipped = VK_TRUE;
  info.oldSwapchain = swapchain_.get();
  const VkDevice handle = device_->get();
  Owned<VkSwapchainKHR, vkDestroySwapchainKHR> renewed;
  TRISECT_VK_ON(*device_, vkCreateSwapchainKHR(handle, &info, nullptr, renewed.fill(handle)));
  swapchain_ = std::move(renewed);
  extent_ = extent;

  uint32_t count = 0;
  TRISECT_VK(vkGetSwapchainImagesKHR(handle, swapchain_.get(), &count, nullptr));
  std::vector<VkImage> images(count);
  TRISECT_VK(vkGetSwapchainImagesKHR(handle, swapchain_.get(), &count, images.data()));
  for (const VkImage image : images) {
    Image& added = images_.emplace_back();
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format_.format;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    TRISECT_VK(vkCreateImageView(handle, &view, nullptr, added.view.fill(handle)));
    const VkImageView attachment = added.view.get();
    VkFramebufferCreateInfo framebuffer{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    framebuffer.renderPass = render_pass_.get();
    framebuffer.attachmentCount = 1;
    framebuffer.pAttachments = &attachment;
    framebuffer.width = extent_.width;
    framebuffer.height = extent_.height;
    framebuffer.layers = 1;
    TRISECT_VK(vkCreateFramebuffer(handle, &framebuffer, nullptr, added.framebuffer.fill(handle)));
    const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    TRISECT_VK(vkCreateSemaphore(handle, &semaphore, nullptr, added.drawn.fill(handle)));
  }
  current_ = true;
  return true;
}

void Swapchain::record(const Image& image, const Recorder& prepare, const Recorder& draw) {
  commands_.begin();
  const VkCommandBuffer commands = commands_.get();
  // The fragment shaders read what compute shaders and copies of earlier submits wrote.
  VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
  vkCmdPipelineBarrier(
      commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
      VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
  prepare(commands);
  VkRenderPassBeginInfo pass{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
  pass.renderPass = render_pass_.get();
  pass.framebuffer = image.framebuffer.get();
  pass.renderArea.extent = extent_;
  vkCmdBeginRenderPass(commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
  const VkViewport viewport{
      0.0F, 0.0F, static_cast<float>(extent_.width), static_cast<float>(extent_.height),
      0.0F, 1.0F};
  const VkRect2D scissor{{0, 0}, extent_};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &scissor);
  draw(commands);
  vkCmdEndRenderPass(commands);
  TRISECT_VK(vkEndCommandBuffer(commands));
}

bool Swapchain::show(uint32_t width, uint32_t height, const Recorder& prepare,
                     const Recorder& draw) {
  wait();
  if (!current_ && !renew(width, height)) return false;
  uint32_t index = 0;
  const VkResult acquisition = vkAcquireNextImageKHR(device_->get(), swapchain_.get(), kForever,
                                                     acquired_.get(), VK_NULL_HANDLE, &index);
  if (acquisition == VK_ERROR_OUT_OF_DATE_KHR) {
    current_ = false;
    return false;
  }
  // A suboptimal image can be presented; the next frame gets new ones.
  if (acquisition != VK_SUBOPTIMAL_KHR) device_->check(acquisition, "vkAcquireNextImageKHR");
  const Image& image = images_[index];
  record(image, prepare, draw);

  const VkFence fence = done_.get();
  TRISECT_VK(vkResetFences(device_->get(), 1, &fence));
  const VkSemaphore acquired = acquired_.get();
  const VkSemaphore drawn = image.drawn.get();
  const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.waitSemaphoreCount = 1;
  submit.pWaitSemaphores = &acquired;
  submit.pWaitDstStageMask = &stage;
  submit.commandBufferCount = 1;
  const VkCommandBuffer commands = commands_.get();
  submit.pCommandBuffers = &commands;
  submit.signalSemaphoreCount = 1;
  submit.pSignalSemaphores = &drawn;
  TRISECT_VK_ON(*device_, vkQueueSubmit(device_->queue(), 1, &submit, fence));

  const VkSwapchainKHR swapchain = swapchain_.get();
  VkPresentInfoKHR present{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
  present.waitSemaphoreCount = 1;
  present.pWaitSemaphores = &drawn;
  present.swapchainCount = 1;
  present.pSwapchains = &swapchain;
  present.pImageIndices = &index;
  const VkResult shown = vkQueuePresentKHR(device_->queue(), &present);
  if (shown == VK_ERROR_OUT_OF_DATE_KHR || shown == VK_SUBOPTIMAL_KHR ||
      acquisition == VK_SUBOPTIMAL_KHR) {
    current_ = false;
    return shown != VK_ERROR_OUT_OF_DATE_KHR;
  }
  device_->check(shown, "vkQueuePresentKHR");
  return true;
}

}  // namespace trisect::gpu
