// Where a command's results go, and what it tells a person meanwhile.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/base/atomic_file.h"
#include "app/picture/image_file.h"

namespace trisect {

// The name of an output that goes to standard output.
inline constexpr const char* kStandardOutput = "-";

// To be called by a command before its work. Throws UsageError as expect_distinct() does. If one of
// the files to be written is kStandardOutput what the command says goes to standard error, so that
// a program that reads the other finds data only.
void begin_outputs(const std::vector<std::string>& read, const std::vector<std::string>& written);

// From now on say() says nothing.
void be_quiet();

// Whether a person watches: standard error is a terminal, and be_quiet() was not called.
bool shows_progress();

// From now on detail() says what it is given.
void be_verbose();

// Writes a text for a person. Throws InputError if standard output cannot be written.
void tell(std::string_view text);

template <typename... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  tell(fmt::format(format, std::forward<Values>(values)...));
}

// Writes a text for a person who wants to know more to standard error, if be_verbose() was called.
void tell_detail(std::string_view text);

template <typename... Values>
void detail(fmt::format_string<Values...> format, Values&&... values) {
  tell_detail(fmt::format(format, std::forward<Values>(values)...));
}

// Prints the messages of the validation layer to standard error. Returns the exit code: there must
// be none.
int report_validation(const std::vector<std::string>& messages);

// Of an image: PNG on standard output, else as image_format() says.
ImageFormat output_format(const std::string& name);

// A file to be written, which appears whole or not at all, or standard output, which gets it at
// once when it is whole.
class Output {
 public:
  // Throws InputError as AtomicFile does.
  explicit Output(const std::string& name);

  // To write to, until commit().
  [[nodiscard]] const AtomicFile& file() const { return *file_; }

  // Throws InputError, naming what cannot be written.
  void commit();

 private:
  bool is_standard_;
  std::optional<AtomicFile> file_;
};

// An output that need not be: none for an empty name.
class OptionalOutput {
 public:
  explicit OptionalOutput(const std::string& name);
  [[nodiscard]] bool is_wanted() const { return output_.has_value(); }
  // These do nothing if it is not. The text is the whole content.
  void write(const std::string& text) const;
  void commit();

 private:
  std::optional<Output> output_;
};

}  // namespace trisect
