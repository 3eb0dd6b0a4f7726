// Allocations of the whole program, its libraries' by operator new too, that fail when a test wants
// it.
#pragma once

#include <cstdint>

namespace trisect::test {

// While it lives, the allocation of this number, from 0, throws std::bad_alloc, in whichever thread
// it is; those after it do not. One at a time.
class FailingAllocation {
 public:
  explicit FailingAllocation(uint64_t number);
  ~FailingAllocation();
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;
  FailingAllocation(FailingAllocation&&) = delete;
  FailingAllocation& operator=(FailingAllocation&&) = delete;

  // Allocations that were asked for.
  [[nodiscard]] static uint64_t count();
};

// Blocks that operator new has given and operator delete has not got back.
int64_t blocks_in_use();

}  // namespace trisect::test
