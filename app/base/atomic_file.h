// Output files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <ostream>
#include <string_view>

#include "app/base/temporary_names.h"

namespace trisect {

// Makes a file in the folder of `target` at once, so that a target that cannot be written is
// noticed before the work and not after it; commit() moves it into place. Without commit() the
// destructor removes it. Where the file system can (O_TMPFILE), it has no name until then, so that
// a process that is killed leaves nothing; else it is a TemporaryName. A target that is a symbolic
// link stays one: the file it leads to is replaced. A file that is replaced keeps its permissions.
class AtomicFile {
 public:
  // Throws InputError, naming the target, if no file can be made there or if it is something other
  // than a regular file.
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  AtomicFile(AtomicFile&&) = delete;
  AtomicFile& operator=(AtomicFile&&) = delete;

  [[nodiscard]] const std::filesystem::path& target() const { return target_; }

  // The file to write to, until commit(), for other processes too.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

  // Writes `text` as the whole content. Throws InputError if that fails.
  void write(std::string_view text) const;

  // The same, of what is put into the stream, part by part.
  void write_parts(const std::function<void(std::ostream& file)>& put) const;

  // Throws InputError if the file cannot be moved.
  void commit();

 private:
  // Makes name_. Throws InputError.
  void make_name();
  [[noreturn]] void fail(int error) const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;
  int unnamed_ = -1;  // the descriptor of a file without a name
  std::optional<TemporaryName> name_;
};

}  // namespace trisect
