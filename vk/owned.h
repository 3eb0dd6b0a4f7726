// Ownership of a Vulkan object that a device made: destroyed with its owner, moved but not copied.
#pragma once

#include <vulkan/vulkan.h>

#include <utility>

namespace trisect::gpu {

// Destroy: the object's vkDestroy or vkFree function. The device must outlive the owner. Like the
// object itself, for one thread at a time.
template <typename Handle, auto Destroy>
class Owned {
 public:
  Owned() = default;
  Owned(VkDevice device, Handle handle) : device_(device), handle_(handle) {}
  Owned(Owned&& other) noexcept
      : device_(other.device_), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
  // Swaps: what this owner held is destroyed with `other`.
  Owned& operator=(Owned&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    return *this;
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() { reset(); }

  [[nodiscard]] Handle get() const { return handle_; }

  // For the out-parameter of a vkCreate call. Destroys what the owner holds first.
  Handle* fill(VkDevice device) {
    reset();
    device_ = device;
    return &handle_;
  }

 private:
  void reset() {
    if (handle_ != VK_NULL_HANDLE) Destroy(device_, handle_, nullptr);
    handle_ = VK_NULL_HANDLE;
  }

  VkDevice device_ = VK_NULL_HANDLE;
  Handle handle_ = VK_NULL_HANDLE;
};

}  // namespace trisect::gpu
