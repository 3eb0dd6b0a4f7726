// The bytes of a model file.
#pragma once

#include <filesystem>
#include <string>

namespace trisect {

// Reads a file; what gzip has compressed is decompressed. Throws InputError with the file's name if
// it cannot be read, is a directory, or is damaged.
std::string read_bytes(const std::filesystem::path& path);

}  // namespace trisect
