// Output files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace trisect {

// Reserves a temporary file beside `target` at once, so that a target that cannot be written is
// found out before the work and not after it; commit() moves it into place. Without commit() the
// destructor removes it. A target that is a symbolic link stays one, a file that is replaced keeps
// its permissions.
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

  // Where to write.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

  // Writes text as the whole content.
  void write(std::string_view text) const;

  // Throws InputError if the file cannot be moved.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
};

}  // namespace trisect
