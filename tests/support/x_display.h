// An X display for one test, with a keyboard and a mouse that the test works.
#pragma once

#include <sys/types.h>

#include <string>

namespace trisect::test {

// Not thread safe, but one thread may use the display while another one runs the program in it.
class XDisplay {
 public:
  // Starts Xvfb with a screen of 1280 x 1024 pixels. Throws if it cannot be started.
  XDisplay();
  ~XDisplay();
  XDisplay(const XDisplay&) = delete;
  XDisplay& operator=(const XDisplay&) = delete;
  XDisplay(XDisplay&&) = delete;
  XDisplay& operator=(XDisplay&&) = delete;

  // The server ends, and with it all connections to it.
  void end();

  // Starts a window manager, which minimises, restores and closes windows and gives them the
  // keyboard's focus.
  void manage_windows();

  // "DISPLAY=:N".
  [[nodiscard]] std::string environment() const { return "DISPLAY=:" + number_; }

  // Waits for a window of this name, up to a minute, and returns its number. A window of the viewer
  // is named after its model from the third frame on. Throws if there is none.
  [[nodiscard]] std::string window_called(const std::string& name) const;

  // The pixels of a square of the window, as a text with a line for each that contains its colour
  // as "0000FF". The square is centred at this position and reaches `around` pixels to each side.
  // Waits until the window can be read, up to a minute. Throws if it cannot.
  [[nodiscard]] std::string pixel(const std::string& window, int x, int y, int around = 0) const;

  // Whether a window of this name is on the screen and not minimised.
  [[nodiscard]] bool shows(const std::string& name) const;

  // Runs xdotool with these arguments and returns its output. Throws if it fails.
  std::string xdotool(const std::string& words) const { return run("xdotool " + words); }

 private:
  [[nodiscard]] std::string run(const std::string& words) const;

  pid_t server_ = -1;
  pid_t manager_ = -1;
  std::string number_;
};

}  // namespace trisect::test
