// Owners of Vulkan objects, here of one that counts how often it is destroyed.
#include "vk/owned.h"

#include <gtest/gtest.h>

#include <utility>

namespace trisect::gpu {
namespace {

struct FakeObject {
  int destroyed = 0;
};
using FakeHandle = FakeObject*;

void destroy_fake(VkDevice /*device*/, FakeHandle object, const VkAllocationCallbacks* /*host*/) {
  ++object->destroyed;
}

using OwnedFake = Owned<FakeHandle, destroy_fake>;

void create_fake(FakeObject& object, FakeHandle* out) {
  *out = &object;
}

TEST(Owned, DestroysWhatItHoldsOnce) {
  FakeObject object;
  {
    OwnedFake owner;
    create_fake(object, owner.fill(VK_NULL_HANDLE));
    EXPECT_EQ(owner.get(), &object);
    EXPECT_EQ(object.destroyed, 0);
  }
  EXPECT_EQ(object.destroyed, 1);
}

TEST(Owned, DestroysWhatItHoldsBeforeItIsFilledAgain) {
  FakeObject first;
  FakeObject second;
  {
    OwnedFake owner;
    create_fake(first, owner.fill(VK_NULL_HANDLE));
    FakeHandle* const out = owner.fill(VK_NULL_HANDLE);
    EXPECT_EQ(first.destroyed, 1);
    EXPECT_EQ(owner.get(), nullptr);
    create_fake(second, out);
  }
  EXPECT_EQ(first.destroyed, 1);
  EXPECT_EQ(second.destroyed, 1);
}

TEST(Owned, MovesWithoutDestroying) {
  FakeObject first;
  FakeObject second;
  {
    OwnedFake a;
    create_fake(first, a.fill(VK_NULL_HANDLE));
    OwnedFake b(std::move(a));
    EXPECT_EQ(b.get(), &first);
    OwnedFake c;
    create_fake(second, c.fill(VK_NULL_HANDLE));
    // Assignment swaps: the other owner destroys what this one held.
    b = std::move(c);
    EXPECT_EQ(b.get(), &second);
    EXPECT_EQ(first.destroyed + second.destroyed, 0);
  }
  EXPECT_EQ(first.destroyed, 1);
  EXPECT_EQ(second.destroyed, 1);
}

}  // namespace
}  // namespace trisect::gpu
