#include "app/cli/model_sha256.h"

#include <fmt/format.h>
#include <sha2.h>

#include <array>
#include <cstdint>
#include <fstream>

#include "app/base/error.h"

namespace trisect {
namespace {

void add_file(const std::filesystem::path& path, SHA2_CTX& context) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 65536> bytes{};
  while (file.read(bytes.data(), bytes.size()), file.gcount() > 0) {
    SHA256Update(&context, reinterpret_cast<const uint8_t*>(bytes.data()),
                 static_cast<size_t>(file.gcount()));
  }
  if (!file.eof()) throw InputError(path.string() + ": could not be read.");
}

}  // namespace

std::string model_sha256(const std::filesystem::path& model,
                         const std::vector<std::filesystem::path>& others) {
  SHA2_CTX context;
  SHA256Init(&context);
  add_file(model, context);
  for (const std::filesystem::path& other : others) add_file(other, context);
  std::array<uint8_t, SHA256_DIGEST_LENGTH> digest{};
  SHA256Final(digest.data(), &context);
  std::string text;
  for (const uint8_t byte : digest) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace trisect
