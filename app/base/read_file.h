// Reading a file whole.
#pragma once

#include <filesystem>
#include <string>

namespace trisect {

// The bytes of a file. Throws InputError with its name if it cannot be opened or read to its end,
// or is a directory.
std::string read_file(const std::filesystem::path& path);

// Throws InputError, in the same words, if a file cannot be opened or is a directory: for libraries
// that open it by its name and say less of why they cannot.
void expect_readable_file(const std::filesystem::path& path);

}  // namespace trisect
