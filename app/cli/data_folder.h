// Where the program finds its models and the sources of its shaders.
#pragma once

#include <filesystem>
#include <string>

namespace trisect {

// The folder of that name that was installed beside the program at `program` (PREFIX/bin/trisect
// has PREFIX/share/trisect/NAME); `in_source_tree` if there is none.
std::filesystem::path data_folder(const std::filesystem::path& program, const std::string& name,
                                  const std::filesystem::path& in_source_tree);

// The same for the program that is running.
std::filesystem::path data_folder(const std::string& name,
                                  const std::filesystem::path& in_source_tree);

}  // namespace trisect
