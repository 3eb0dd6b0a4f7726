// What the machine does not have is refused before it is taken.
#include "app/base/memory.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "app/base/error.h"
#include "app/frame/frame.h"

namespace trisect {
namespace {

TEST(Memory, FreeIsLessThanTheMachineHas) {
  std::ifstream file("/proc/meminfo");
  std::string name;
  uint64_t kibibytes = 0;
  file >> name >> kibibytes;
  ASSERT_EQ(name, "MemTotal:");
  ASSERT_TRUE(free_memory());
  EXPECT_GT(*free_memory(), 0U);
  EXPECT_LT(*free_memory(), kibibytes * 1024);
}

TEST(Memory, ThatIsNotThereIsRefusedInASentence) {
  EXPECT_NO_THROW(expect_memory(1e6, "nothing"));
  EXPECT_NO_THROW(expect_memory(0.5 * static_cast<double>(*free_memory()), "half"));
  EXPECT_THROW(expect_memory(static_cast<double>(*free_memory()), "all"), OutOfMemory);
  try {
    expect_memory(5.12e15, "a model");
    FAIL() << "nothing was thrown";
  } catch (const OutOfMemory& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with("a model needs 5120000.0 GB of memory, and ")) << text;
    EXPECT_TRUE(text.ends_with(" GB are free.")) << text;
  }
}

TEST(Memory, OfAFrameIsLookedAtFirst) {
  Frame frame;
  frame.resize(4, 3, true);
  EXPECT_THROW(frame.resize(1U << 21U, 1U << 21U, true), OutOfMemory);
  // It is as it was.
  EXPECT_EQ(frame.colors.size(), 12U);
  EXPECT_EQ(frame.width, 4U);
}

}  // namespace
}  // namespace trisect
