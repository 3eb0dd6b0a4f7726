// The program on a driver whose calls fail, one at a time.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/failing_calls.h"
#include "tests/support/file_content.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

using test::FailingCommand;
using test::Fault;

// There is one instance only.
const Fault kNone{"vkCreateInstance", 2, "VK_ERROR_OUT_OF_HOST_MEMORY"};

FailingCommand render(std::vector<std::string> options,
                      const std::vector<std::string>& environment = {}) {
  options.insert(options.begin(), {"render", test::asset_path("sphere-20"), "--size", "32x24", "-o",
                                   "FOLDER/a.png", "--stats", "FOLDER/s.json"});
  return FailingCommand(options, environment);
}

void expect_each_told(const FailingCommand& command, const std::vector<Fault>& faults) {
  for (const test::FaultyRun& run : command.run_all(faults)) {
    // Pipelines that cannot be kept are compiled again by the next run.
    if (run.fault.function == "vkGetPipelineCacheData") {
      test::expect_unimpressed(run, {"a.png", "s.json"});
    } else {
      test::expect_told(run);
    }
  }
}

TEST(FailingCalls, AreToldByKindWhicheverCallOfARenderItIs) {
  const FailingCommand command = render({"--accel", "tiles", "--shadows"});
  const std::vector<Fault> faults = test::every_call(command.calls());
  EXPECT_GT(faults.size(), 200U);
  expect_each_told(command, faults);
}

TEST(FailingCalls, AreToldByKindWithEveryAcceleration) {
  std::vector<FailingCommand> commands{render({"--accel", "list"}), render({"--accel", "bvh"})};
  const FailingCommand by_queries = render({"--accel", "rayquery"});
  if (by_queries.run(kNone).program.exit_code == 0) commands.push_back(by_queries);
  std::size_t turn = 1;
  for (const FailingCommand& command : commands) {
    const std::vector<Fault> faults = test::first_and_last_calls(command.calls(), turn++);
    EXPECT_GT(faults.size(), 40U);
    expect_each_told(command, faults);
  }
}

TEST(FailingCalls, AreToldByOtherCommands) {
  const FailingCommand devices({"devices"});
  const std::vector<Fault> all = test::every_call(devices.calls());
  // The instance's, two for the list of devices, and two for each one's extensions.
  EXPECT_GE(all.size(), 5U);
  for (const test::FaultyRun& run : devices.run_all(all)) test::expect_told(run);

  const FailingCommand bench({"bench", "speed", test::asset_path("sphere-20"), "--surface", "phong",
                              "--runs", "1", "--size", "32x24", "--error", "1e-2", "--json",
                              "FOLDER/b.json"});
  for (const test::FaultyRun& run :
       bench.run_all({{"vkCreateComputePipelines", 5, "VK_ERROR_OUT_OF_HOST_MEMORY"},
                      {"vkAllocateMemory", 20, "VK_ERROR_OUT_OF_DEVICE_MEMORY"},
                      {"vkWaitForFences", 10, "VK_ERROR_DEVICE_LOST"}})) {
    test::expect_told(run);
  }
}

// Nobody waits longer than a second for a driver that does not come back.
TEST(HangingCalls, AreInterrupted) {
  const test::TemporaryFolder folder;
  const std::string environment = fmt::format("{} VK_INSTANCE_LAYERS=VK_LAYER_TRISECT_fault",
                                              test::layer_environment("fault").front());
  for (const auto& [call, signal] : {std::pair("vkCreateDevice", "TERM"),
                                     {"vkCreateComputePipelines", "INT"},
                                     {"vkCreateComputePipelines", "HUP"},
                                     {"vkWaitForFences", "QUIT"}}) {
    // SIGKILL, exit code 137, ends a program that does not end by itself.
    const std::string line = fmt::format(
        "{} TRISECT_TEST_FAIL={}:1:HANG timeout --preserve-status -s {} -k 30 1.5 {} render {} -o "
        "{} >/dev/null 2>{}",
        environment, call, signal, test::program_path(), test::asset_path("cube"),
        (folder / "a.png").string(), (folder / "err").string());
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 130) << call << ", " << signal;
    EXPECT_EQ(test::content_of(folder / "err"), "trisect: interrupted\n") << call;
    std::filesystem::remove(folder / "err");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << call << ", " << signal;
  }
}

// Or the tests above would pass by a layer that stands in the way.
TEST(FailingCalls, AreNoneIfTheProgramMakesFewer) {
  test::expect_unimpressed(render({}).run(kNone), {"a.png", "s.json"});
}

TEST(FailingCalls, ShowTheReportOfADriverThatHasOne) {
  const FailingCommand command = render({}, {"TRISECT_TEST_FAULT_REPORT=1"});
  const test::FaultyRun run = command.run({"vkWaitForFences", 2, "VK_ERROR_DEVICE_LOST"});
  test::expect_told(run);
  EXPECT_NE(run.program.err.find("a fault of the test; invalid read at 0x12345000 to 0x12345fff; "
                                 "an engine (code 0x2a, data 0x7)"),
            std::string::npos)
      << run.program.err;
  // Nothing is asked of a device that is not lost.
  test::expect_told(command.run({"vkWaitForFences", 2, "VK_ERROR_OUT_OF_HOST_MEMORY"}));
}

// A picture alone is traced once; frames that are timed have one before them.
TEST(Calls, TraceAFrameMoreOnlyWhereItIsTimed) {
  const auto submits = [](const std::vector<std::string>& options) {
    const std::vector<std::string> calls = render(options).calls();
    return std::count(calls.begin(), calls.end(), "vkQueueSubmit");
  };
  const auto alone = submits({});
  const auto of_a_frame = submits({"--runs", "1"}) - alone;
  EXPECT_GT(of_a_frame, 0);
  EXPECT_EQ(submits({"--runs", "3"}), alone + 3 * of_a_frame);
}

// What an earlier run kept is of no use then, but nothing else is wrong.
TEST(FailingCalls, OfThePipelineStoreDoNoHarm) {
  const test::TemporaryFolder cache;
  const FailingCommand command = render({}, {"XDG_CACHE_HOME=" + cache.path().string()});
  test::expect_unimpressed(command.run({"vkMergePipelineCaches", 1, "VK_ERROR_OUT_OF_HOST_MEMORY"}),
                           {"a.png", "s.json"});
  const std::vector<std::string> calls = command.calls();
  EXPECT_EQ(std::count(calls.begin(), calls.end(), "vkMergePipelineCaches"), 1);
  for (const Fault& fault : {Fault{"vkMergePipelineCaches", 1, "VK_ERROR_OUT_OF_DEVICE_MEMORY"},
                             Fault{"vkCreatePipelineCache", 2, "VK_ERROR_INITIALIZATION_FAILED"}}) {
    test::expect_unimpressed(command.run(fault), {"a.png", "s.json"});
  }
}

}  // namespace
}  // namespace trisect
