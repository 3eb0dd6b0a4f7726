// For the functions of one_input.h.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>

#include "app/base/error.h"
#include "tests/fuzz/one_input.h"
#include "tests/support/temporary_folder.h"

namespace trisect::fuzz {

inline void expect(bool is_right, const std::string& what) {
  if (!is_right) throw Finding(what);
}

// How many inputs were answered with an error.
inline uint64_t& refusals() {
  static uint64_t count = 0;
  return count;
}

// Calls it. The errors that a user can cause are right answers, if they say something.
template <typename Call>
void expect_answer(const Call& call) {
  const auto refused = [](const char* words) {
    ++refusals();
    expect(words[0] != '\0', "an error without words");
  };
  try {
    call();
  } catch (const UsageError& error) {
    refused(error.what());
  } catch (const InputError& error) {
    refused(error.what());
  }
}

inline std::string text_of(Bytes bytes) {
  return {bytes.begin(), bytes.end()};
}

// Numbers out of an input, one after the other; zeros where it has ended.
class Numbers {
 public:
  explicit Numbers(Bytes bytes) : bytes_(bytes) {}

  [[nodiscard]] bool has_ended() const { return bytes_.empty(); }

  template <typename Number>
  Number next() {
    Number number{};
    const std::size_t size = std::min(sizeof(number), bytes_.size());
    std::memcpy(&number, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
    return number;
  }

 private:
  Bytes bytes_;
};

// Files for the program to read, in a folder of this process's own, below $TMPDIR.
inline std::filesystem::path input_folder() {
  static const test::TemporaryFolder folder;
  return folder.path();
}

inline std::filesystem::path write_input(const std::string& name, Bytes content) {
  std::filesystem::path path = input_folder() / name;
  // Not by a stream, to which it is a failure to write if there is no memory.
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) throw std::runtime_error("an input could not be made");
  const bool is_written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
  if (std::fclose(file) != 0 || !is_written) {
    throw std::runtime_error("an input could not be written");
  }
  return path;
}

}  // namespace trisect::fuzz
