#include "tests/support/failing_calls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>
#include <utility>

#include "tests/support/command_in_folder.h"
#include "tests/support/file_content.h"
#include "tests/support/temporary_folder.h"

namespace trisect::test {
namespace {

// A run takes a tenth of a second: one that takes a minute hangs.
constexpr int kSecondsAtMost = 60;

constexpr std::array<std::pair<const char*, int>, 4> kResults{
    {{"VK_ERROR_OUT_OF_DEVICE_MEMORY", 6},
     {"VK_ERROR_DEVICE_LOST", 5},
     {"VK_ERROR_OUT_OF_HOST_MEMORY", 6},
     {"VK_ERROR_INITIALIZATION_FAILED", 4}}};

std::string description_of(const FaultyRun& run) {
  return run.fault.function + ", call " + std::to_string(run.fault.call) + ", " + run.fault.result +
         ": exit code " + std::to_string(run.program.exit_code) + ", \"" + run.program.err + "\"";
}

}  // namespace

int exit_code_of(const std::string& result) {
  const auto* found =
      std::find_if(kResults.begin(), kResults.end(),
                   [&](const std::pair<const char*, int>& entry) { return entry.first == result; });
  return found->second;
}

std::vector<Fault> every_call(const std::vector<std::string>& calls, std::size_t turn) {
  std::vector<Fault> faults;
  faults.reserve(calls.size());
  std::map<std::string, std::size_t> counts;
  for (const std::string& function : calls) {
    faults.push_back({function, ++counts[function], kResults[turn++ % kResults.size()].first});
  }
  return faults;
}

std::vector<Fault> first_and_last_calls(const std::vector<std::string>& calls, std::size_t turn) {
  std::map<std::string, std::size_t> counts;
  for (const std::string& function : calls) ++counts[function];
  std::vector<Fault> faults;
  for (const auto& [function, count] : counts) {
    faults.push_back({function, 1, kResults[turn++ % kResults.size()].first});
    if (count > 1) faults.push_back({function, count, kResults[turn++ % kResults.size()].first});
  }
  return faults;
}

FaultyRun FailingCommand::run_with(const std::string& variable) const {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "out";
  const std::filesystem::path log = folder / "log";
  const std::filesystem::path settings = folder / "vk_layer_settings.txt";
  std::filesystem::create_directory(out);
  std::ofstream(settings) << "khronos_validation.debug_action = VK_DBG_LAYER_ACTION_LOG_MSG\n"
                          << "khronos_validation.report_flags = error,warn\n"
                          << "khronos_validation.log_filename = " << log.string() << "\n";
  std::vector<std::string> environment = layer_environment("fault");
  environment.back() += ":VK_LAYER_KHRONOS_validation";
  environment.insert(
      environment.end(),
      {"VK_LAYER_SETTINGS_PATH=" + settings.string(), "TRISECT_TEST_EMPTY_KERNELS=1",
       "XDG_CACHE_HOME=" + (folder / "cache").string(),
       // Another layer between would make calls of its own.
       "NODEVICE_SELECT=1",
       // What nobody writes, as the kernels are empty, is 0 and not different in every run.
       "MALLOC_PERTURB_=255"});
  environment.insert(environment.end(), environment_.begin(), environment_.end());
  environment.push_back(variable);
  FaultyRun result;
  result.program = run_trisect(in_folder(arguments_, out), environment, kSecondsAtMost);
  for (const auto& entry : std::filesystem::directory_iterator(out)) {
    result.files.push_back(entry.path().filename());
  }
  std::sort(result.files.begin(), result.files.end());
  result.misuse = content_of(log);
  return result;
}

std::vector<std::string> FailingCommand::calls() const {
  const TemporaryFolder folder;
  const FaultyRun plain = run_with("TRISECT_TEST_CALLS=" + (folder / "calls").string());
  EXPECT_EQ(plain.program.exit_code, 0) << plain.program.err;
  EXPECT_EQ(plain.misuse, "");
  std::istringstream names(content_of(folder / "calls"));
  std::vector<std::string> calls;
  for (std::string name; names >> name;) calls.push_back(name);
  return calls;
}

FaultyRun FailingCommand::run(const Fault& fault) const {
  FaultyRun result = run_with("TRISECT_TEST_FAIL=" + fault.function + ":" +
                              std::to_string(fault.call) + ":" + fault.result);
  result.fault = fault;
  return result;
}

std::vector<FaultyRun> FailingCommand::run_all(const std::vector<Fault>& faults) const {
  std::vector<FaultyRun> runs(faults.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < faults.size(); i = next++) runs[i] = run(faults[i]);
  };
  std::thread other(work);
  work();
  other.join();
  return runs;
}

void expect_told(const FaultyRun& run) {
  const std::string& err = run.program.err;
  EXPECT_EQ(run.program.exit_code, exit_code_of(run.fault.result)) << description_of(run);
  EXPECT_EQ(err.find("trisect: "), 0U) << description_of(run);
  EXPECT_NE(err.find("(" + run.fault.result), std::string::npos) << description_of(run);
  EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << description_of(run);
  EXPECT_EQ(err.find(".\n"), err.size() - 2) << description_of(run);
  EXPECT_TRUE(run.files.empty()) << description_of(run) << " left " << run.files.front();
  EXPECT_EQ(run.misuse, "") << description_of(run);
}

void expect_unimpressed(const FaultyRun& run, const std::vector<std::string>& files) {
  EXPECT_EQ(run.program.exit_code, 0) << description_of(run);
  EXPECT_EQ(run.program.err, "") << description_of(run);
  EXPECT_EQ(run.files, files) << description_of(run);
  EXPECT_EQ(run.misuse, "") << description_of(run);
}

}  // namespace trisect::test
