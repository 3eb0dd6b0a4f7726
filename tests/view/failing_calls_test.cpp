// The window on a driver whose calls fail, one at a time.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "tests/support/failing_calls.h"
#include "tests/support/scenes.h"
#include "tests/support/x_display.h"

namespace trisect {
namespace {

const std::vector<std::string> kFiles{"a.png", "s.json"};

class FailingView : public ::testing::Test {
 protected:
  [[nodiscard]] test::FailingCommand view() const {
    return test::FailingCommand(
        {"view", test::asset_path("sphere-20"), "--size", "64x48", "--frames", "5", "--screenshot",
         "FOLDER/a.png", "--stats", "FOLDER/s.json"},
        {display_.environment()});
  }

  test::XDisplay display_;
};

// How often a function is called depends on time: the last of its calls may come in one run and not
// in the next.
TEST_F(FailingView, EndsByKindOrGoesOn) {
  const test::FailingCommand command = view();
  const std::vector<std::string> calls = command.calls();
  const std::vector<test::Fault> faults = test::first_and_last_calls(calls);
  EXPECT_GT(faults.size(), 70U);
  std::map<std::string, int> told;
  for (const test::FaultyRun& run : command.run_all(faults)) {
    const bool is_needed = run.fault.call == 1 && run.fault.function != "vkGetPipelineCacheData";
    if (is_needed || run.program.exit_code != 0) {
      test::expect_told(run);
      ++told[run.fault.result];
    } else {
      test::expect_unimpressed(run, kFiles);
    }
  }
  EXPECT_EQ(told.size(), 4U);
}

// The device is lost while frames are shown, when other errors would become a message in the panel.
TEST_F(FailingView, ClosesIfTheDeviceIsLost) {
  const test::FailingCommand command = view();
  for (const test::FaultyRun& run :
       command.run_all({{"vkQueueSubmit", 4, "VK_ERROR_DEVICE_LOST"},
                        {"vkQueueSubmit", 12, "VK_ERROR_DEVICE_LOST"},
                        {"vkWaitForFences", 12, "VK_ERROR_DEVICE_LOST"},
                        {"vkGetQueryPoolResults", 6, "VK_ERROR_DEVICE_LOST"},
                        {"vkGetQueryPoolResults", 7, "VK_ERROR_DEVICE_LOST"}})) {
    test::expect_told(run);
    // At once, and not when the next frame is to be drawn.
    EXPECT_NE(run.program.err.find("lost at " + run.fault.function), std::string::npos)
        << run.program.err;
  }
}

}  // namespace
}  // namespace trisect
