// The kernels that trace the window's frames: the built-in ones, or those compiled last from the
// folder of the shaders' sources.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "app/buffers/kernel_code.h"
#include "app/view/clock.h"

namespace trisect::view {

// Not thread safe.
class KernelSource {
 public:
  explicit KernelSource(std::string folder);

  [[nodiscard]] const std::string& folder() const { return folder_; }

  // Compiles the folder's sources; throws what compile_kernels() throws.
  [[nodiscard]] std::shared_ptr<const KernelCode> compile() const;

  // Frames are traced by these kernels from now on.
  void use(std::shared_ptr<const KernelCode> code) {
    code_ = std::move(code);
    ++number_;
  }

  // Null for the built-in kernels.
  [[nodiscard]] const std::shared_ptr<const KernelCode>& code() const { return code_; }

  // How often other kernels came into use.
  [[nodiscard]] uint64_t number() const { return number_; }

  // Whether a file of the folder was written since this function last said so. Looks at the folder
  // four times a second at most and says no in between.
  bool has_changed(Clock::time_point now);

 private:
  std::string folder_;
  std::shared_ptr<const KernelCode> code_;
  uint64_t number_ = 0;
  std::filesystem::file_time_type last_write_;
  Clock::time_point last_look_;
};

}  // namespace trisect::view
