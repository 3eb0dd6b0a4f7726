#include "app/mesh/file_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <new>
#include <system_error>

#include "app/base/error.h"
#include "app/base/memory.h"
#include "app/base/read_file.h"

namespace trisect {
namespace {

[[noreturn]] void fail_damaged(const std::string& name) {
  throw InputError(name + ": is compressed by gzip, and damaged or cut off.");
}

// Decompresses what begins with gzip's two bytes, 0x1f 0x8b (RFC 1952); it may be several such
// streams, one after the other.
std::string decompressed(std::string& bytes, const std::string& name) {
  z_stream stream{};
  constexpr int gzip_window = 15 + 16;  // the largest window, with gzip's header
  if (inflateInit2(&stream, gzip_window) != Z_OK) throw std::bad_alloc();
  struct End {
    z_stream* stream;
    ~End() { inflateEnd(stream); }
  };
  const End end{&stream};
  std::string plain;
  std::string buffer(std::size_t{1} << 18U, '\0');
  std::size_t used = 0;
  while (used < bytes.size()) {
    const std::size_t given = std::min(bytes.size() - used, std::size_t{1} << 30U);
    stream.next_in = reinterpret_cast<Bytef*>(bytes.data() + used);
    stream.avail_in = static_cast<uInt>(given);
    int result = Z_OK;
    while (result == Z_OK && (stream.avail_in > 0 || stream.avail_out == 0)) {
      stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
      stream.avail_out = static_cast<uInt>(buffer.size());
      result = inflate(&stream, Z_NO_FLUSH);
      const std::size_t more = buffer.size() - stream.avail_out;
      // A thousand times the file's size, at most (RFC 1951).
      if (plain.size() + more > plain.capacity()) {
        expect_memory(2.0 * static_cast<double>(plain.capacity()), name);
      }
      plain.append(buffer.data(), more);
    }
    used += given - stream.avail_in;
    if (result == Z_STREAM_END) {
      // Padding with zeros may follow.
      while (used < bytes.size() && bytes[used] == '\0') ++used;
      if (used == bytes.size()) return plain;
      if (inflateReset(&stream) != Z_OK) fail_damaged(name);
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      fail_damaged(name);
    }
  }
  fail_damaged(name);
}

}  // namespace

std::string read_bytes(const std::filesystem::path& path) {
  std::string bytes = read_file(path);
  if (bytes.starts_with("\x1f\x8b")) return decompressed(bytes, path.string());
  return bytes;
}

std::optional<std::filesystem::path> file_below(const std::filesystem::path& folder,
                                                const std::filesystem::path& name) {
  if (name.empty() || name.is_absolute()) return std::nullopt;
  std::error_code error;
  const std::filesystem::path inside = std::filesystem::weakly_canonical(folder, error);
  const std::filesystem::path file = std::filesystem::weakly_canonical(folder / name, error);
  if (error) return std::nullopt;
  const std::filesystem::path relative = file.lexically_relative(inside);
  if (relative.empty() || *relative.begin() == "..") return std::nullopt;
  return file;
}

}  // namespace trisect
