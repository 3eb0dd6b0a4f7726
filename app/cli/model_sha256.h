// The checksum that says which model a picture is of.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trisect {

// SHA-256 (FIPS 180-4) of the bytes of the model's file and of `others`, PolygonModel::files, one
// after the other, as 64 hexadecimal digits: what `cat MODEL OTHERS | sha256sum` says. Throws
// InputError, naming a file that cannot be read.
std::string model_sha256(const std::filesystem::path& model,
                         const std::vector<std::filesystem::path>& others);

}  // namespace trisect
