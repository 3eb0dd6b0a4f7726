// The entry of libFuzzer. TRISECT_FUZZED is the function of one_input.h that the program is for.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/one_input.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  trisect::fuzz::TRISECT_FUZZED({data, size});
  return 0;
}
