#include "tests/support/x_display.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <stdexcept>

namespace trisect::test {

XDisplay::XDisplay() {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) throw std::runtime_error("no pipe");
  server_ = fork();
  if (server_ == 0) {
    close(pipe[0]);
    // The server picks a free number and writes it to the pipe once it accepts connections.
    const std::string number = std::to_string(pipe[1]);
    execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "1280x1024x24",
           "-nolisten", "tcp", "-noreset", nullptr);
    _exit(127);
  }
  close(pipe[1]);
  for (char c = 0; read(pipe[0], &c, 1) == 1 && c != '\n';) number_ += c;
  close(pipe[0]);
  if (number_.empty()) throw std::runtime_error("Xvfb did not start; is it installed?");
}

XDisplay::~XDisplay() {
  if (manager_ > 0) {
    kill(manager_, SIGTERM);
    waitpid(manager_, nullptr, 0);
  }
  end();
}

void XDisplay::end() {
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
  server_ = -1;
}

void XDisplay::manage_windows() {
  manager_ = fork();
  if (manager_ == 0) {
    setenv("DISPLAY", (":" + number_).c_str(), 1);
    // openbox complains about missing menus, which do not matter here.
    if (freopen("/dev/null", "w", stderr) == nullptr) _exit(127);
    execlp("openbox", "openbox", "--sm-disable", nullptr);
    _exit(127);
  }
  // A window manager sets this property of the root window when it is ready.
  for (int i = 0;
       run("xprop -root _NET_SUPPORTING_WM_CHECK").find("window id") == std::string::npos; ++i) {
    if (i == 100) throw std::runtime_error("openbox did not start; is it installed?");
    usleep(50000);
  }
}

bool XDisplay::shows(const std::string& name) const {
  return !run("xdotool search --onlyvisible --name '" + name + "' || true").empty();
}

std::string XDisplay::run(const std::string& words) const {
  const std::string command = "export " + environment() + "; " + words + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("no shell could be started");
  std::string output;
  std::array<char, 256> part{};
  while (fgets(part.data(), part.size(), pipe) != nullptr) output += part.data();
  if (pclose(pipe) != 0) throw std::runtime_error(command + ": " + output);
  return output;
}

std::string XDisplay::window_called(const std::string& name) const {
  for (int i = 0; i < 1200; ++i) {
    const std::string windows = run("xdotool search --name '" + name + "' || true");
    if (!windows.empty()) return windows.substr(0, windows.find('\n'));
    // openbox may overlook a request that its Xlib has already read, until another event comes.
    xdotool("set_desktop 0 || true");
    usleep(50000);
  }
  throw std::runtime_error("no window is called " + name);
}

std::string XDisplay::pixel(const std::string& window, int x, int y, int around) const {
  const int side = 2 * around + 1;
  const std::string part = std::to_string(side) + "x" + std::to_string(side) + "+" +
                           std::to_string(x - around) + "+" + std::to_string(y - around);
  // Without such a window, import would wait for a click on another one.
  const std::string import =
      "timeout 60 import -silent -window " + window + " -crop " + part + " -depth 8 txt:- || true";
  std::string output;
  // While openbox maps a window, even one that is viewable, the server may refuse to read it.
  for (int i = 0; i < 240; ++i) {
    output = run(import);
    // The text format has a line for each pixel, "0,0: (0,0,255)  #0000FF  blue".
    if (output.find("0,0: ") != std::string::npos) return output;
    usleep(250000);
  }
  throw std::runtime_error("window " + window + " cannot be read: " + output);
}

}  // namespace trisect::test
