// A display of its own for a test, and hands on its keyboard and mouse.
#pragma once

#include <sys/types.h>

#include <string>

namespace trisect::test {

class XDisplay {
 public:
  // Starts Xvfb with a screen of 1280 x 1024 pixels. Throws if it cannot be started.
  XDisplay();
  ~XDisplay();
  XDisplay(const XDisplay&) = delete;
  XDisplay& operator=(const XDisplay&) = delete;
  XDisplay(XDisplay&&) = delete;
  XDisplay& operator=(XDisplay&&) = delete;

  // Starts a window manager, which minimises, restores and closes windows and gives them the keys.
  void manage_windows();

  // "DISPLAY=:N".
  [[nodiscard]] std::string environment() const { return "DISPLAY=:" + number_; }

  // The number of a window of this name, once there is one: a viewer's from its third frame on.
  [[nodiscard]] std::string window_called(const std::string& name) const;

  // What a window shows at a position and so many pixels around it, as text: "0000FF" for each
  // pixel.
  [[nodiscard]] std::string pixel(const std::string& window, int x, int y, int around = 0) const;

  // Whether a window of this name is on the screen: not minimised.
  [[nodiscard]] bool shows(const std::string& name) const;

  // Runs xdotool with these words; its output. Throws if it fails.
  std::string xdotool(const std::string& words) const { return run("xdotool " + words); }

 private:
  [[nodiscard]] std::string run(const std::string& words) const;

  pid_t server_ = -1;
  pid_t manager_ = -1;
  std::string number_;
};

}  // namespace trisect::test
