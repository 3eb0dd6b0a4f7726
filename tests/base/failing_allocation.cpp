#include "tests/base/failing_allocation.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>

namespace trisect::test {
namespace {

constexpr uint64_t kNone = std::numeric_limits<uint64_t>::max();
std::atomic<uint64_t> failing_number{kNone};
std::atomic<uint64_t> asked_for{0};
std::atomic<int64_t> in_use{0};

// align: a power of two; size: in bytes.
void* allocate(std::size_t size, std::size_t align) {
  if (failing_number != kNone && asked_for++ == failing_number) throw std::bad_alloc();
  const std::size_t whole = (size / align + 1) * align;
  void* block =
      align > alignof(std::max_align_t) ? std::aligned_alloc(align, whole) : std::malloc(whole);
  if (block == nullptr) throw std::bad_alloc();
  ++in_use;
  return block;
}

void give_back(void* block) {
  if (block != nullptr) --in_use;
  std::free(block);
}

}  // namespace

FailingAllocation::FailingAllocation(uint64_t number) {
  asked_for = 0;
  failing_number = number;
}

FailingAllocation::~FailingAllocation() {
  failing_number = kNone;
}

uint64_t FailingAllocation::count() {
  return asked_for;
}

int64_t blocks_in_use() {
  return in_use;
}

}  // namespace trisect::test

// The standard library's other forms come down to these; a sanitizer's do not, so that the one that
// operator delete goes with is here, too.
void* operator new(std::size_t size) {
  return trisect::test::allocate(size, 1);
}
void* operator new(std::size_t size, std::align_val_t align) {
  return trisect::test::allocate(size, static_cast<std::size_t>(align));
}
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* block) noexcept {
  trisect::test::give_back(block);
}
void operator delete(void* block, std::size_t /*size*/) noexcept {
  trisect::test::give_back(block);
}
void operator delete(void* block, std::align_val_t /*align*/) noexcept {
  trisect::test::give_back(block);
}
void operator delete(void* block, std::size_t /*size*/, std::align_val_t /*align*/) noexcept {
  trisect::test::give_back(block);
}
