// What is read, built, baked and written while an allocation fails, each one in its turn: either
// that is told as what it is, or the answer is the same. Nothing is left behind.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <assimp/Importer.hpp>
#include <cstdio>
#include <exception>
#include <map>
#include <new>
#include <set>
#include <string>

#include "app/base/error.h"
#include "app/cli/interrupt.h"
#include "tests/base/failing_allocation.h"
#include "tests/fuzz/answers.h"
#include "tests/fuzz/one_input.h"
#include "tests/fuzz/seeds.h"

namespace trisect {
namespace {

// No run has so many allocations.
constexpr uint64_t kNever = uint64_t{1} << 60U;

// Exit codes of children, beside those of the program.
constexpr int kBlocksLeft = 90;
constexpr int kOtherAnswer = 91;

using Answer = void (*)(fuzz::Bytes);

void answer_to(Answer answer, const fuzz::Seed& seed) {
  answer({reinterpret_cast<const uint8_t*>(seed.content.data()), seed.content.size()});
}

// How many of the input's allocations are not made to fail. Assimp 5.2 leaks, or gives back what it
// never had, if its own do: for the formats that it reads these are all until it is done.
uint64_t left_alone(const fuzz::Seed& seed) {
  constexpr std::array<const char*, 3> by_assimp{"ply", "stl", "fbx"};
  constexpr char first_of_them = 3;  // of model_input's endings
  if (seed.kind != "model" || seed.content[0] < first_of_them) return 0;
  constexpr uint64_t more_than_before_it = 100;
  const test::FailingAllocation none(kNever);
  Assimp::Importer importer;
  EXPECT_NE(importer.ReadFileFromMemory(
                seed.content.data() + 1, seed.content.size() - 1, 0,
                by_assimp.at(static_cast<std::size_t>(seed.content[0] - first_of_them))),
            nullptr);
  return more_than_before_it + test::FailingAllocation::count();
}

// In a process of its own, as some libraries' destructors allocate, too: there the process ends,
// and its exit code tells why. refusals: of the input when nothing fails.
int exit_code_of(Answer answer, const fuzz::Seed& seed, uint64_t failing, uint64_t refusals) {
  const pid_t child = fork();
  if (child == 0) {
    tell_what_nothing_catches();
    close(STDERR_FILENO);  // on which that is told
    const uint64_t before = fuzz::refusals();
    const int64_t blocks = test::blocks_in_use();
    int code = exit_done;
    {
      const test::FailingAllocation fail(failing);
      try {
        answer_to(answer, seed);
      } catch (const std::bad_alloc&) {
        code = exit_out_of_memory;
      } catch (const std::exception& error) {
        std::puts(error.what());
        std::fflush(stdout);
        code = kOtherAnswer;
      }
    }
    if (test::blocks_in_use() > blocks) code = kBlocksLeft;
    if (fuzz::refusals() - before > refusals) code = exit_bad_input;
    _exit(code);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

// OpenEXR 3.1 leaks if its allocations fail, and takes it for a failure to write if those of its
// strings' streams do.
bool is_exr(const fuzz::Seed& seed) {
  return seed.kind == "picture" && seed.content[0] % 2 == 1;
}

// most: runs of one input; of more allocations every second, third ... fails.
void expect_each_told(const char* kind, Answer answer, uint64_t most) {
  std::size_t inputs = 0;
  uint64_t all_runs = 0;
  for (const fuzz::Seed& seed : fuzz::seeds_of({TRISECT_ASSETS})) {
    if (seed.kind != kind) continue;
    SCOPED_TRACE(std::string(kind) + " " + std::to_string(++inputs));
    // What libraries keep from the first time on is no loss.
    answer_to(answer, seed);
    const uint64_t before = fuzz::refusals();
    uint64_t allocations = 0;
    {
      const test::FailingAllocation none(kNever);
      answer_to(answer, seed);
      allocations = test::FailingAllocation::count();
    }
    const uint64_t refusals = fuzz::refusals() - before;
    std::set<int> right{exit_done, exit_out_of_memory};
    if (is_exr(seed)) right.insert({kBlocksLeft, exit_bad_input});
    std::map<int, uint64_t> runs;  // by their exit codes
    const uint64_t first = left_alone(seed);
    ASSERT_LT(first, allocations);
    for (uint64_t i = first; i < allocations; i += (allocations - first) / most + 1) {
      const int code = exit_code_of(answer, seed, i, refusals);
      EXPECT_TRUE(right.contains(code))
          << "allocation " << i << " of " << allocations << ": exit code " << code;
      ++runs[code];
      ++all_runs;
    }
    EXPECT_GT(runs[exit_out_of_memory] + runs[kBlocksLeft],
              20 * (runs[exit_done] + runs[exit_bad_input]));
  }
  EXPECT_GT(inputs, 0U);
  ::testing::Test::RecordProperty("runs", std::to_string(all_runs));
}

TEST(FailingAllocations, AreToldByReadersOfModelsAndTheBake) {
  expect_each_told("model", fuzz::model_input, 150);
}

TEST(FailingAllocations, AreToldByReadersOfCameraPaths) {
  expect_each_told("path", fuzz::path_input, 300);
}

TEST(FailingAllocations, AreToldByReadersAndWritersOfPictures) {
  expect_each_told("picture", fuzz::picture_input, 300);
}

}  // namespace
}  // namespace trisect
