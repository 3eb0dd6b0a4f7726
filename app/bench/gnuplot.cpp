#include "app/bench/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "app/base/error.h"
#include "app/base/temporary_names.h"

namespace trisect::bench {
namespace {

// Runs gnuplot with one argument and discards its output. Returns its exit code, or -1 if it did
// not run.
int gnuplot(std::string argument) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string name = "gnuplot";
  std::array<char*, 3> arguments{name.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int failed =
      posix_spawnp(&child, name.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return -1;
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
  return WEXITSTATUS(status);
}

}  // namespace

void expect_gnuplot() {
  if (gnuplot("--version") != 0) {
    throw InputError("the plots need gnuplot, which is not installed.");
  }
}

void run_gnuplot(const std::string& script) {
  try {
    const TemporaryName file(std::filesystem::temp_directory_path(), 0600);
    std::ofstream(file.path()) << script;
    if (gnuplot(file.path().string()) != 0) throw InputError("gnuplot could not draw a plot.");
  } catch (const std::system_error&) {
    throw InputError("no temporary file can be made for gnuplot.");
  }
}

std::string gnuplot_text(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += c;
    quoted += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  }
  return quoted + "'";
}

std::vector<std::string> distinct(const std::vector<std::string>& names) {
  std::vector<std::string> result;
  for (const std::string& name : names) {
    if (std::find(result.begin(), result.end(), name) == result.end()) result.push_back(name);
  }
  return result;
}

std::string curve_style(const std::vector<std::string>& names, std::size_t k) {
  // All around the circle of hues, light and dark by turns.
  return fmt::format("pt {} lc rgb hsv2rgb({:.3f}, 1, {}) title {} noenhanced", k + 1,
                     static_cast<double>(k) / static_cast<double>(names.size()),
                     k % 2 == 0 ? 0.9 : 0.6, gnuplot_text(names[k]));
}

std::string page(const std::string& terminal, const std::string& file, const std::string& layout,
                 const std::string& title) {
  return fmt::format("set terminal {}\nset output {}\nset multiplot {} title {} noenhanced\n",
                     terminal, gnuplot_text(file), layout.empty() ? "" : "layout " + layout,
                     gnuplot_text(title));
}

std::string two_panels(const std::string& terminal, const std::string& file,
                       const std::string& title) {
  return page(terminal, file, "1,2", title) +
         "set logscale xy\nset offsets graph 0.05, graph 0.05, 0, 0\nset grid\n"
         "set key outside bottom center horizontal maxcols 2\n";
}

}  // namespace trisect::bench
