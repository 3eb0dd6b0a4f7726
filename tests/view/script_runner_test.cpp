// What a script does and when, by a clock that the tests set.
#include "app/view/script_runner.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "app/surface/shared.h"
#include "app/view/window.h"

namespace trisect::view {
namespace {

// Writes down what it is asked for.
class RecordedActions : public ScriptActions {
 public:
  void press_key(int key) override { calls.push_back("press " + std::to_string(key)); }
  void apply_flags(const std::string& text) override { calls.push_back("flags " + text); }
  void show_output(unsigned int output) override {
    calls.push_back("shown " + std::to_string(output));
  }
  void resize_window(uint32_t width, uint32_t height) override {
    calls.push_back("size " + std::to_string(width) + " " + std::to_string(height));
  }
  void open_model(const std::string& file) override { calls.push_back("open " + file); }
  void save_picture_to(const std::string& file) override { calls.push_back("save " + file); }
  void measure_error() override { calls.emplace_back("error"); }
  void quit() override { calls.emplace_back("quit"); }

  std::vector<std::string> calls;
};

constexpr Clock::time_point kStart{std::chrono::hours(1)};

Clock::time_point at(double seconds) {
  return kStart +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

TEST(ScriptRunner, DoesEveryCommand) {
  ScriptRunner runner({{0.0, "press", "w"},
                       {0.0, "flags", "--fov 60 --spp 4"},
                       {0.0, "shown", "depth"},
                       {0.0, "size", "64x48"},
                       {0.0, "open", "a b.obj"},
                       {0.0, "save", "c.png"},
                       {0.0, "error", ""},
                       {0.0, "quit", ""}});
  RecordedActions actions;
  runner.start(kStart);
  while (runner.run_next(actions, kStart)) {
  }
  const std::vector<std::string> expected{"press " + std::to_string(GLFW_KEY_W),
                                          "flags --fov 60 --spp 4",
                                          "shown " + std::to_string(SHOWN_DEPTH),
                                          "size 64 48",
                                          "open a b.obj",
                                          "save c.png",
                                          "error",
                                          "quit"};
  EXPECT_EQ(actions.calls, expected);
}

TEST(ScriptRunner, DoesOneStepAtATimeWhenItIsDue) {
  ScriptRunner runner({{0.5, "error", ""}, {0.5, "press", "1"}, {2.0, "quit", ""}});
  RecordedActions actions;
  runner.start(kStart);
  EXPECT_FALSE(runner.is_due(at(0.4)));
  EXPECT_FALSE(runner.run_next(actions, at(0.4)));
  EXPECT_NEAR(*runner.seconds_until_next(at(0.4)), 0.1, 1e-6);
  EXPECT_TRUE(runner.is_due(at(0.6)));
  EXPECT_TRUE(runner.run_next(actions, at(0.6)));
  EXPECT_EQ(actions.calls.size(), 1U);
  EXPECT_LT(*runner.seconds_until_next(at(0.6)), 0.0);
  EXPECT_TRUE(runner.run_next(actions, at(0.6)));
  EXPECT_FALSE(runner.run_next(actions, at(0.6)));
  EXPECT_EQ(actions.calls.size(), 2U);
  // However late it is.
  EXPECT_TRUE(runner.run_next(actions, at(100.0)));
  EXPECT_EQ(actions.calls.back(), "quit");
  EXPECT_FALSE(runner.is_due(at(200.0)));
  EXPECT_FALSE(runner.seconds_until_next(at(200.0)));
}

TEST(ScriptRunner, DoesNothingBeforeItsStart) {
  ScriptRunner runner({{0.0, "quit", ""}});
  RecordedActions actions;
  EXPECT_FALSE(runner.has_started());
  EXPECT_FALSE(runner.run_next(actions, at(50.0)));
  EXPECT_FALSE(runner.seconds_until_next(at(50.0)));
  EXPECT_FALSE(runner.is_due(at(50.0)));
  runner.start(at(50.0));
  EXPECT_TRUE(runner.has_started());
  EXPECT_TRUE(runner.run_next(actions, at(50.0)));
}

TEST(ScriptRunner, HeldKeysEnd) {
  ScriptRunner runner({{1.0, "hold", "w 0.5"}, {1.0, "hold", "space 2"}});
  RecordedActions actions;
  runner.start(kStart);
  EXPECT_FALSE(runner.holds(GLFW_KEY_W, at(1.0)));
  // A step that is done late holds its key from then on.
  while (runner.run_next(actions, at(3.0))) {
  }
  EXPECT_TRUE(actions.calls.empty());
  EXPECT_TRUE(runner.holds(GLFW_KEY_W, at(3.0)));
  EXPECT_TRUE(runner.holds(GLFW_KEY_W, at(3.49)));
  EXPECT_FALSE(runner.holds(GLFW_KEY_W, at(3.51)));
  EXPECT_TRUE(runner.holds(GLFW_KEY_SPACE, at(4.9)));
  EXPECT_FALSE(runner.holds(GLFW_KEY_SPACE, at(5.1)));
  EXPECT_FALSE(runner.holds(GLFW_KEY_A, at(3.0)));
}

TEST(ScriptRunner, AHeldKeyMayBeHeldAgain) {
  ScriptRunner runner({{0.0, "hold", "w 1"}, {0.5, "hold", "w 1"}});
  RecordedActions actions;
  runner.start(kStart);
  runner.run_next(actions, at(0.0));
  runner.run_next(actions, at(0.5));
  EXPECT_TRUE(runner.holds(GLFW_KEY_W, at(1.25)));
  EXPECT_FALSE(runner.holds(GLFW_KEY_W, at(1.75)));
}

}  // namespace
}  // namespace trisect::view
