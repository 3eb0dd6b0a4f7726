#include "app/view/panel_layer.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include "vk/command_buffer.h"
#include "vk/result.h"

namespace trisect::view {
namespace {

void check_result(VkResult result) {
  gpu::check(result, "a call of Dear ImGui");
}

// Uploads the font's texture, by a command buffer of its own.
void upload_font(const gpu::Device& device) {
  gpu::CommandBuffer buffer(device);
  buffer.begin();
  const VkCommandBuffer commands = buffer.get();
  ImGui_ImplVulkan_CreateFontsTexture(commands);
  TRISECT_VK(vkEndCommandBuffer(commands));
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  TRISECT_VK_ON(device, vkQueueSubmit(device.queue(), 1, &submit, VK_NULL_HANDLE));
  TRISECT_VK_WAIT(device, vkQueueWaitIdle(device.queue()));
  ImGui_ImplVulkan_DestroyFontUploadObjects();
}

}  // namespace

PanelLayer::PanelLayer(const gpu::Device& device, const Window& window) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
  VkDescriptorPoolCreateInfo pool{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  pool.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  pool.maxSets = 1;
  pool.poolSizeCount = 1;
  pool.pPoolSizes = &size;
  TRISECT_VK(vkCreateDescriptorPool(device.get(), &pool, nullptr, pool_.fill(device.get())));
  ImGui::CreateContext();
  // The layout is not kept between runs, which would otherwise not be reproducible.
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::StyleColorsDark();
  ImGui_ImplGlfw_InitForVulkan(window.get(), true);
}

PanelLayer::PanelLayer(const gpu::Instance& instance, const gpu::Device& device,
                       const Window& window, VkRenderPass render_pass)
    : PanelLayer(device, window) {
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = instance.get();
  info.PhysicalDevice = device.physical();
  info.Device = device.get();
  info.QueueFamily = device.family();
  info.Queue = device.queue();
  info.PipelineCache = device.pipeline_cache();
  info.DescriptorPool = pool_.get();
  // Two sets of vertex buffers, the fewest that ImGui takes. One would do, as the swapchain waits
  // for the last frame before it draws the next.
  info.MinImageCount = 2;
  info.ImageCount = 2;
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = check_result;
  ImGui_ImplVulkan_Init(&info, render_pass);
  upload_font(device);
}

PanelLayer::~PanelLayer() {
  if (ImGui::GetIO().BackendRendererUserData != nullptr) ImGui_ImplVulkan_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void PanelLayer::begin() {
  ImGui_ImplVulkan_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void PanelLayer::end() {
  ImGui::Render();
}

void PanelLayer::draw(VkCommandBuffer commands) {
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
}

bool PanelLayer::wants_keys() {
  return ImGui::GetIO().WantTextInput;
}

bool PanelLayer::wants_mouse() {
  return ImGui::GetIO().WantCaptureMouse;
}

}  // namespace trisect::view
