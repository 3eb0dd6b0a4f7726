#include "app/bench/report_files.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "app/base/atomic_file.h"
#include "app/base/error.h"
#include "app/base/threads.h"
#include "app/bench/gnuplot.h"

namespace trisect::bench {

ReportFolder::ReportFolder(const std::string& path) : path_(path) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (error) throw InputError(fmt::format("{}: {}.", path, error.message()));
}

void ReportFolder::write(const std::string& name, const std::string& text) const {
  AtomicFile file(path_ / name);
  file.write(text);
  file.commit();
}

void ReportFolder::plot(
    const std::string& name,
    const std::function<std::string(const std::string&, const std::string&)>& script) const {
  for (const auto& [ending, terminal] :
       {std::pair{".svg", "svg size 1200,620 dynamic background rgb \"white\""},
        std::pair{".png", "pngcairo size 1200,620"}}) {
    AtomicFile file(path_ / (name + ending));
    run_gnuplot(script(terminal, file.temporary().string()));
    file.commit();
  }
}

std::string frames_fact(const TimedModels& options) {
  return fmt::format("{}x{} pixels, {} frames each after a warm-up, in turns", options.width,
                     options.height, options.runs);
}

std::string threads_fact() {
  return fmt::format("CPU: {} threads", worker_threads());
}

}  // namespace trisect::bench
