// SPIR-V that was compiled while the program runs.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace trisect {

// SPIR-V words by the kernel's name in shaders/CMakeLists.txt, such as "trace_tiles".
using KernelCode = std::map<std::string, std::vector<uint32_t>, std::less<>>;

}  // namespace trisect
