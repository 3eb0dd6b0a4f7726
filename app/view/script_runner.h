// Does what a script says, when it is due.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/view/clock.h"
#include "app/view/script.h"

namespace trisect::view {

// What a script may have a window do.
class ScriptActions {
 public:
  ScriptActions() = default;
  virtual ~ScriptActions() = default;
  ScriptActions(const ScriptActions&) = delete;
  ScriptActions& operator=(const ScriptActions&) = delete;
  ScriptActions(ScriptActions&&) = delete;
  ScriptActions& operator=(ScriptActions&&) = delete;

  virtual void press_key(int key) = 0;                    // GLFW_KEY_...
  virtual void apply_flags(const std::string& text) = 0;  // options of `trisect render`
  virtual void show_output(unsigned int output) = 0;      // SHOWN_...
  virtual void resize_window(uint32_t width, uint32_t height) = 0;
  virtual void open_model(const std::string& file) = 0;
  virtual void save_picture_to(const std::string& file) = 0;
  virtual void measure_error() = 0;
  virtual void quit() = 0;
};

// The times of a script count from start(); before that nothing is due.
// Not thread safe.
class ScriptRunner {
 public:
  // Steps as read_script() returns them: valid, and in the order of time.
  explicit ScriptRunner(std::vector<ScriptStep> steps) : steps_(std::move(steps)) {}

  void start(Clock::time_point now) { start_ = now; }
  [[nodiscard]] bool has_started() const { return start_.has_value(); }

  // Does the next step if it is due; returns whether it was. An exception of the action passes
  // through, and the step counts as done.
  bool run_next(ScriptActions& actions, Clock::time_point now);

  // Whether the time of the next step has come.
  [[nodiscard]] bool is_due(Clock::time_point now) const;

  // Seconds until the next step, possibly negative; nothing before start() and after the last one.
  [[nodiscard]] std::optional<double> seconds_until_next(Clock::time_point now) const;

  // Whether a `hold` step holds this key now.
  [[nodiscard]] bool holds(int key, Clock::time_point now) const;

 private:
  struct HeldKey {
    int key;
    double until;  // seconds since the start
  };

  // Seconds since the start.
  [[nodiscard]] double elapsed(Clock::time_point now) const;
  void perform(const ScriptStep& step, ScriptActions& actions, Clock::time_point now);

  std::vector<ScriptStep> steps_;
  std::size_t next_ = 0;
  std::vector<HeldKey> held_;
  std::optional<Clock::time_point> start_;
};

}  // namespace trisect::view
