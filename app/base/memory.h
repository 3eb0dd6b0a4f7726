// How much memory the machine has left, asked before much is taken: Linux gives what it does not
// have, and ends the program later.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace trisect {

// Bytes that this process can still use without swapping, as far as the kernel says (MemAvailable
// of /proc/meminfo, and the limits of its control groups, version 2); nothing if it does not.
std::optional<uint64_t> free_memory();

// Throws OutOfMemory, "WHAT needs 17.2 GB of memory, and 5.1 GB are free.", if `bytes` are more
// than nine tenths of what is free: some is needed beside. Less than a quarter of a gigabyte is not
// looked at. what: "an image of 16384x16384 pixels".
void expect_memory(double bytes, const std::string& what);

}  // namespace trisect
