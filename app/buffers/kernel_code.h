// SPIR-V of the kernels by their names.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace trisect {

// Name of a kernel, as in "trace_tiles", and its SPIR-V.
using KernelCode = std::map<std::string, std::vector<uint32_t>, std::less<>>;

}  // namespace trisect
