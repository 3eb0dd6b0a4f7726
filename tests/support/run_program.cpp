#include "tests/support/run_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <thread>
#include <utility>

#include "tests/support/file_content.h"
#include "tests/support/temporary_folder.h"

namespace trisect::test {
namespace {

std::string name_of(const std::string& entry) {
  return entry.substr(0, entry.find('='));
}

std::vector<std::string> last_of_each_name(const std::vector<std::string>& environment) {
  std::map<std::string, std::string> entries;
  for (const std::string& entry : environment) entries[name_of(entry)] = entry;
  std::vector<std::string> last;
  last.reserve(entries.size());
  for (const auto& [name, entry] : entries) last.push_back(entry);
  return last;
}

// Ends the child if it takes longer.
void wait_for(pid_t child, int& status, int seconds_at_most) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds_at_most);
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

// What a run is sent, and when; 0: nothing.
struct SignalAfter {
  int number = 0;
  int ms = 0;
};

ProgramRun run(std::vector<std::string> words, const std::vector<std::string>& environment,
               const SignalAfter& signal, int seconds_at_most) {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  const std::string err = folder / "err";

  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::vector<std::string> added = last_of_each_name(environment);
  std::vector<char*> envp;
  const auto is_replaced = [&](const std::string& entry) {
    return std::any_of(added.begin(), added.end(),
                       [&](const std::string& other) { return name_of(entry) == name_of(other); });
  };
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (!is_replaced(*entry)) envp.push_back(*entry);
  }
  for (std::string& entry : added) envp.push_back(entry.data());
  envp.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), flags, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), flags, 0600);
  // Whoever started the tests may have signals ignored (nohup, a job in the background), which
  // would be inherited.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t signals;
  sigemptyset(&signals);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) sigaddset(&signals, number);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t child = 0;
  const int spawned =
      posix_spawnp(&child, argv.front(), &actions, &attributes, argv.data(), envp.data());
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (spawned != 0) throw std::runtime_error("cannot start " + words.front());
  if (signal.number != 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(signal.ms));
    kill(child, signal.number);
  }
  const auto begin = std::chrono::steady_clock::now();
  int status = 0;
  if (seconds_at_most > 0) {
    wait_for(child, status, seconds_at_most);
  } else {
    waitpid(child, &status, 0);
  }
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  const auto taken = std::chrono::steady_clock::now() - begin;
  return {code, content_of(out), content_of(err),
          static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(taken).count())};
}

std::vector<std::string> trisect_with(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), program_path());
  return arguments;
}

}  // namespace

std::string program_path() {
  return std::filesystem::read_symlink("/proc/self/exe").replace_filename("trisect").string();
}

ProgramRun run_program(std::vector<std::string> words, const std::vector<std::string>& environment,
                       int seconds_at_most) {
  return run(std::move(words), environment, {}, seconds_at_most);
}

ProgramRun run_trisect(const std::vector<std::string>& arguments,
                       const std::vector<std::string>& environment, int seconds_at_most) {
  return run(trisect_with(arguments), environment, {}, seconds_at_most);
}

std::vector<std::string> layer_environment(const std::string& layer) {
  return {"VK_ADD_LAYER_PATH=" TRISECT_LAYERS, "VK_INSTANCE_LAYERS=VK_LAYER_TRISECT_" + layer};
}

ProgramRun signal_trisect(const std::vector<std::string>& arguments, int after_ms, int signal,
                          const std::vector<std::string>& environment) {
  return run(trisect_with(arguments), environment, {signal, after_ms}, 0);
}

}  // namespace trisect::test
