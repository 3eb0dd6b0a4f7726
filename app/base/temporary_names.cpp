#include "app/base/temporary_names.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <random>
#include <string>
#include <string_view>
#include <system_error>

namespace trisect {
namespace {

// Names of files to remove, null where there is none. Only who swaps a name for null may go on with
// it: its owner, or remove_temporary_files().
constexpr std::size_t kSlots = 64;
std::array<std::atomic<const char*>, kSlots> names{};
static_assert(std::atomic<const char*>::is_always_lock_free);

// Where the name is kept; kSlots if all places are taken.
std::size_t keep(const char* name) {
  std::size_t slot = 0;
  for (; slot < kSlots; ++slot) {
    const char* expected = nullptr;
    if (names[slot].compare_exchange_strong(expected, name)) break;
  }
  return slot;
}

std::string random_letters() {
  static constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::uniform_int_distribution<std::size_t> pick(0, kLetters.size() - 1);
  std::string text(6, ' ');
  for (char& letter : text) letter = kLetters[pick(random)];
  return text;
}

}  // namespace

TemporaryName::TemporaryName(const std::filesystem::path& folder, mode_t mode) {
  for (int attempt = 0;; ++attempt) {
    path_ = folder / (".trisect-" + random_letters());
    const int file = open(path_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, mode);
    if (file >= 0) {
      close(file);
      break;
    }
    if (errno != EEXIST || attempt == 100) throw std::system_error(errno, std::generic_category());
  }
  slot_ = keep(path_.c_str());
}

TemporaryName::~TemporaryName() {
  if (path_.empty()) return;
  unlink(path_.c_str());
  release();
}

void TemporaryName::release() {
  if (slot_ < kSlots && names[slot_].exchange(nullptr) == nullptr) {
    // remove_temporary_files() has the name and reads it; the process ends after that.
    for (;;) pause();
  }
  path_.clear();
}

void remove_temporary_files() noexcept {
  for (std::atomic<const char*>& name : names) {
    if (const char* file = name.exchange(nullptr)) unlink(file);
  }
}

}  // namespace trisect
