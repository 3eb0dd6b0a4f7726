#include "app/cli/output.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "app/base/error.h"
#include "app/base/message.h"
#include "app/base/read_file.h"
#include "app/cli/distinct_files.h"
#include "app/cli/standard_output.h"

namespace trisect {
namespace {

enum class Told { standard_output, standard_error, nothing };

// A process has one standard output.
Told told = Told::standard_output;
bool is_verbose = false;

// Where an output waits for being whole before it goes to standard output.
std::filesystem::path waiting_place() {
  return std::filesystem::temp_directory_path() / fmt::format("trisect-{}", getpid());
}

// Makes the folder of a file.
void make_folder(const std::filesystem::path& file) {
  if (!file.has_parent_path()) return;
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error) {
    throw InputError(fmt::format("{}: the folder cannot be made: {}.", file.parent_path().string(),
                                 error.message()));
  }
}

// A file without a name, as AtomicFile's are at first, can be where the name cannot.
void expect_possible_name(const std::string& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error) || !error) return;
  throw InputError(fmt::format("{}: cannot be written: {}.", file, error.message()));
}

}  // namespace

void begin_outputs(const std::vector<std::string>& read, const std::vector<std::string>& written) {
  if (std::count(written.begin(), written.end(), kStandardOutput) > 1) {
    throw UsageError("-: standard output takes one output.");
  }
  expect_distinct(read, written);
  const bool has_data = std::find(written.begin(), written.end(), kStandardOutput) != written.end();
  if (has_data && told == Told::standard_output) told = Told::standard_error;
}

void be_quiet() {
  told = Told::nothing;
}

bool shows_progress() {
  return told != Told::nothing && isatty(STDERR_FILENO) == 1;
}

void be_verbose() {
  is_verbose = true;
}

void tell_detail(std::string_view text) {
  if (!is_verbose) return;
  const std::string shown = escaped_lines(text);
  std::fwrite(shown.data(), 1, shown.size(), stderr);
}

void tell(std::string_view text) {
  const std::string shown = escaped_lines(text);
  if (told == Told::standard_output) write_standard_output(shown);
  if (told == Told::standard_error) std::fwrite(shown.data(), 1, shown.size(), stderr);
}

int report_validation(const std::vector<std::string>& messages) {
  for (const std::string& message : messages) {
    fmt::print(stderr, "validation: {}\n", escaped_lines(message));
  }
  return messages.empty() ? exit_done : exit_internal;
}

ImageFormat output_format(const std::string& name) {
  return name == kStandardOutput ? ImageFormat::png : image_format(name);
}

Output::Output(const std::string& name) : is_standard_(name == kStandardOutput) {
  if (!is_standard_) {
    make_folder(name);
    expect_possible_name(name);
  }
  file_.emplace(is_standard_ ? waiting_place() : std::filesystem::path(name));
}

void Output::commit() {
  if (!is_standard_) {
    file_->commit();
    return;
  }
  write_standard_output(read_file(file_->temporary()));
}

OptionalOutput::OptionalOutput(const std::string& name) {
  if (!name.empty()) output_.emplace(name);
}

void OptionalOutput::write(const std::string& text) const {
  if (output_) output_->file().write(text);
}

void OptionalOutput::commit() {
  if (output_) output_->commit();
}

}  // namespace trisect
