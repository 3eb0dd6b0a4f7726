// What fuzzers have found is answered as it should be.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "tests/fuzz/one_input.h"
#include "tests/support/file_content.h"

namespace trisect {
namespace {

const std::pair<const char*, void (*)(fuzz::Bytes)> kKinds[] = {{"model", fuzz::model_input},
                                                                {"path", fuzz::path_input},
                                                                {"picture", fuzz::picture_input},
                                                                {"text", fuzz::text_input},
                                                                {"solver", fuzz::solver_input}};

// The folder of a kind has the fuzzer's name, and holds an input in each file.
TEST(FuzzRegressions, AreAnswered) {
  for (const auto& [kind, answer] : kKinds) {
    const std::filesystem::path folder = std::filesystem::path(TRISECT_REGRESSIONS) / kind;
    std::size_t inputs = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      SCOPED_TRACE(entry.path());
      const std::string content = test::content_of(entry.path());
      ++inputs;
      EXPECT_NO_THROW(answer({reinterpret_cast<const uint8_t*>(content.data()), content.size()}));
    }
    EXPECT_GT(inputs, 0U) << folder;
  }
}

}  // namespace
}  // namespace trisect
