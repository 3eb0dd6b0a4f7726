#include "app/bench/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "app/base/error.h"

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

// A temporary file, removed by the destructor.
class Script {
 public:
  explicit Script(const std::string& text) {
    std::string name = (std::filesystem::temp_directory_path() / "trisect-XXXXXX").string();
    const int file = mkstemp(name.data());
    if (file < 0) throw InputError("no temporary file can be made for gnuplot.");
    close(file);
    path_ = name;
    std::ofstream(path_) << text;
  }
  ~Script() {
    std::error_code unused;
    std::filesystem::remove(path_, unused);
  }
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;
  Script(Script&&) = delete;
  Script& operator=(Script&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

void expect_gnuplot() {
  if (gnuplot("--version") != 0) {
    throw InputError("the plots need gnuplot, which is not installed.");
  }
}

void run_gnuplot(const std::string& script) {
  const Script file(script);
  if (gnuplot(file.path().string()) != 0) throw InputError("gnuplot could not draw a plot.");
}

}  // namespace trisect::bench
