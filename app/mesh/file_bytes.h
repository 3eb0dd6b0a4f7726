// The bytes of a model file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace trisect {

// Reads a file; what gzip has compressed is decompressed. Throws InputError with the file's name if
// it cannot be read, is a directory, or is damaged.
std::string read_bytes(const std::filesystem::path& path);

// The file that another one names, as `name`, relative to the folder that it is in. Nothing if that
// is not in the folder or below it, links followed.
std::optional<std::filesystem::path> file_below(const std::filesystem::path& folder,
                                                const std::filesystem::path& name);

}  // namespace trisect
