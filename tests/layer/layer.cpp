#include "tests/layer/layer.h"

#include <vulkan/vk_layer.h>

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <string_view>
#include <utility>

namespace trisect::layer {
namespace {

std::span<const Hook> own_hooks();

// What is below the layer, for one instance or one device.
struct Chain {
  VkInstance instance = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  PFN_vkGetInstanceProcAddr get_instance_function = nullptr;
  PFN_vkGetDeviceProcAddr get_device_function = nullptr;  // of a device only
  // The functions that the layer has hooks for, asked for at once: when the instance is made the
  // loader answers with the first layer's functions, not with those below this one.
  std::map<std::string_view, PFN_vkVoidFunction> hooked;

  void ask_for_hooked() {
    for (const Hook& hook : own_hooks()) hooked[hook.name] = ask(hook.name);
    for (const Hook& hook : hooks()) hooked[hook.name] = ask(hook.name);
  }
  [[nodiscard]] PFN_vkVoidFunction get(const char* name) const {
    const auto found = hooked.find(name);
    return found != hooked.end() ? found->second : ask(name);
  }

 private:
  [[nodiscard]] PFN_vkVoidFunction ask(const char* name) const {
    return device != VK_NULL_HANDLE ? get_device_function(device, name)
                                    : get_instance_function(instance, name);
  }
};

// The loader writes the same pointer to the beginning of an instance and of its physical devices,
// and another one to that of a device, its queues and its command buffers.
void* key_of(const void* handle) {
  return *static_cast<void* const*>(handle);
}

std::mutex chains_mutex;
std::map<void*, Chain> chains;

// Null before the instance or the device is made.
const Chain* chain_of(const void* handle) {
  const std::lock_guard lock(chains_mutex);
  const auto found = handle == nullptr ? chains.end() : chains.find(key_of(handle));
  return found == chains.end() ? nullptr : &found->second;
}

void add_chain(const void* handle, Chain chain) {
  chain.ask_for_hooked();
  const std::lock_guard lock(chains_mutex);
  chains[key_of(handle)] = std::move(chain);
}

void remove_chain(void* key) {
  const std::lock_guard lock(chains_mutex);
  chains.erase(key);
}

// The structure in which the loader hands down the next layers.
template <typename Link>
Link* link_of(const void* next, VkStructureType type) {
  for (auto* at = static_cast<const VkBaseInStructure*>(next); at != nullptr; at = at->pNext) {
    auto* link = reinterpret_cast<Link*>(const_cast<VkBaseInStructure*>(at));
    if (at->sType == type && link->function == VK_LAYER_LINK_INFO) return link;
  }
  return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* allocator,
                                               VkInstance* instance) {
  auto* link = link_of<VkLayerInstanceCreateInfo>(info->pNext,
                                                  VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  Chain chain;
  chain.get_instance_function = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;  // the next layer's
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(
      chain.get_instance_function(VK_NULL_HANDLE, "vkCreateInstance"));
  const VkResult result = create(info, allocator, instance);
  if (result != VK_SUCCESS) return result;
  chain.instance = *instance;
  add_chain(*instance, std::move(chain));
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical,
                                             const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator,
                                             VkDevice* device) {
  auto* link =
      link_of<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
  Chain chain;
  chain.instance = chain_of(physical)->instance;
  chain.get_device_function = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  const auto create = reinterpret_cast<PFN_vkCreateDevice>(
      link->u.pLayerInfo->pfnNextGetInstanceProcAddr(chain.instance, "vkCreateDevice"));
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const VkResult result = create(physical, info, allocator, device);
  if (result != VK_SUCCESS) return result;
  chain.device = *device;
  add_chain(*device, std::move(chain));
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroy_instance(VkInstance instance,
                                            const VkAllocationCallbacks* allocator) {
  if (instance == VK_NULL_HANDLE) return;
  void* key = key_of(instance);
  const auto destroy =
      reinterpret_cast<PFN_vkDestroyInstance>(chain_of(instance)->get("vkDestroyInstance"));
  destroy(instance, allocator);
  remove_chain(key);
}

VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice device, const VkAllocationCallbacks* allocator) {
  if (device == VK_NULL_HANDLE) return;
  void* key = key_of(device);
  const auto destroy =
      reinterpret_cast<PFN_vkDestroyDevice>(chain_of(device)->get("vkDestroyDevice"));
  destroy(device, allocator);
  remove_chain(key);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_function(VkInstance instance,
                                                               const char* name);
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_function(VkDevice device, const char* name);

// The functions without which there is no layer.
std::span<const Hook> own_hooks() {
  static const std::array own{TRISECT_HOOK(vkGetInstanceProcAddr, get_instance_function),
                              TRISECT_HOOK(vkGetDeviceProcAddr, get_device_function),
                              TRISECT_HOOK(vkCreateInstance, create_instance),
                              TRISECT_HOOK(vkDestroyInstance, destroy_instance),
                              TRISECT_HOOK(vkCreateDevice, create_device),
                              TRISECT_HOOK(vkDestroyDevice, destroy_device)};
  return own;
}

const Hook* find(std::span<const Hook> among, std::string_view name) {
  const auto found = std::find_if(among.begin(), among.end(),
                                  [name](const Hook& hook) { return hook.name == name; });
  return found == among.end() ? nullptr : &*found;
}

// What a program gets for a name: the layer's function, or `below` if the layer has none.
PFN_vkVoidFunction resolve(std::string_view name, PFN_vkVoidFunction below) {
  const Hook* own = find(own_hooks(), name);
  const Hook* hook = find(hooks(), name);
  if (hook != nullptr && (hook->always || own != nullptr || below != nullptr)) {
    return hook->function;
  }
  return own != nullptr ? own->function : below;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_instance_function(VkInstance instance,
                                                               const char* name) {
  // The loader asks for vkCreateInstance before there is a chain.
  const Chain* chain = chain_of(instance);
  return resolve(name, chain == nullptr ? nullptr : chain->get(name));
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_function(VkDevice device, const char* name) {
  return resolve(name, chain_of(device)->get(name));
}

}  // namespace

PFN_vkVoidFunction next_function(void* handle, const char* name) {
  if (const Hook* own = find(own_hooks(), name)) return own->function;
  return chain_of(handle)->get(name);
}

VkDevice device_of(void* handle) {
  return chain_of(handle)->device;
}

}  // namespace trisect::layer

// The one function that the loader looks up by its name.
extern "C" __attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* version) {
  if (version->loaderLayerInterfaceVersion < 2) return VK_ERROR_INITIALIZATION_FAILED;
  version->loaderLayerInterfaceVersion = 2;
  version->pfnGetInstanceProcAddr = trisect::layer::get_instance_function;
  version->pfnGetDeviceProcAddr = trisect::layer::get_device_function;
  version->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
