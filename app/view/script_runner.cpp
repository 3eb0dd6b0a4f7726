#include "app/view/script_runner.h"

#include <algorithm>
#include <sstream>

#include "app/cli/options.h"
#include "app/view/panel.h"

namespace trisect::view {

double ScriptRunner::elapsed(Clock::time_point now) const {
  return start_ ? seconds_between(*start_, now) : 0.0;
}

bool ScriptRunner::is_due(Clock::time_point now) const {
  return start_ && next_ < steps_.size() && steps_[next_].seconds <= elapsed(now);
}

std::optional<double> ScriptRunner::seconds_until_next(Clock::time_point now) const {
  if (!start_ || next_ == steps_.size()) return std::nullopt;
  return steps_[next_].seconds - elapsed(now);
}

bool ScriptRunner::holds(int key, Clock::time_point now) const {
  return std::any_of(held_.begin(), held_.end(), [&](const HeldKey& held) {
    return held.key == key && held.until > elapsed(now);
  });
}

bool ScriptRunner::run_next(ScriptActions& actions, Clock::time_point now) {
  if (!is_due(now)) return false;
  perform(steps_[next_++], actions, now);
  return true;
}

void ScriptRunner::perform(const ScriptStep& step, ScriptActions& actions, Clock::time_point now) {
  if (step.command == "hold") {
    std::istringstream words(step.argument);
    std::string name;
    double seconds = 0.0;
    words >> name >> seconds;
    held_.push_back({key_named(name), elapsed(now) + seconds});
  } else if (step.command == "press") {
    actions.press_key(key_named(step.argument));
  } else if (step.command == "flags") {
    actions.apply_flags(step.argument);
  } else if (step.command == "shown") {
    actions.show_output(shown_named(step.argument).value_or(SHOWN_COLOR));
  } else if (step.command == "size") {
    uint32_t width = 0;
    uint32_t height = 0;
    parse_size("size", step.argument, width, height);
    actions.resize_window(width, height);
  } else if (step.command == "open") {
    actions.open_model(step.argument);
  } else if (step.command == "save") {
    actions.save_picture_to(step.argument);
  } else if (step.command == "error") {
    actions.measure_error();
  } else {
    actions.quit();
  }
}

}  // namespace trisect::view
