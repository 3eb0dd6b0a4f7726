// The files of a report.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "app/bench/options.h"

namespace trisect::bench {

class ReportFolder {
 public:
  // Makes the folder if it is not there. Throws InputError if it cannot be made.
  explicit ReportFolder(const std::string& path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  // Files appear whole or not at all. Throws InputError.
  void write(const std::string& name, const std::string& text) const;

  // NAME.svg and NAME.png, by script(gnuplot's terminal, file).
  void plot(const std::string& name,
            const std::function<std::string(const std::string&, const std::string&)>& script) const;

 private:
  std::filesystem::path path_;
};

// For the facts of a report: what frames were timed.
std::string frames_fact(const TimedModels& options);

// On how many threads of the CPU.
std::string threads_fact();

}  // namespace trisect::bench
