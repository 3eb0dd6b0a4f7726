// Files of a command that must not be one and the same.
#pragma once

#include <string>
#include <vector>

namespace trisect {

// Throws UsageError if a file to be written is one of those that are read, or one to be written
// twice, by whatever path. An empty name is no file.
void expect_distinct(const std::vector<std::string>& read, const std::vector<std::string>& written);

}  // namespace trisect
