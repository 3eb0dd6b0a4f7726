#include "app/mesh/obj_file.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <fstream>
#include <ios>
#include <streambuf>
#include <system_error>
#include <utility>

#include "app/base/error.h"

namespace trisect {
namespace {

// A text in memory as a stream that counts the lines that have been read from it, so that errors
// can name the line.
class CountingBuffer : public std::streambuf {
 public:
  explicit CountingBuffer(std::string_view text) : text_(text) {}

  [[nodiscard]] std::size_t lines_read() const { return lines_; }

 protected:
  int_type underflow() override {
    return at_ < text_.size() ? traits_type::to_int_type(text_[at_]) : traits_type::eof();
  }
  int_type uflow() override {
    if (at_ >= text_.size()) return traits_type::eof();
    const char c = text_[at_++];
    // A line ends with \n, \r\n or a lone \r.
    if (c == '\n' || (c == '\r' && (at_ >= text_.size() || text_[at_] != '\n'))) ++lines_;
    return traits_type::to_int_type(c);
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t lines_ = 0;
};

// Removes the first word from `line` and returns it; empty at the end of the line.
std::string_view take_word(std::string_view& line) {
  constexpr std::string_view spaces = " \t\r";
  const std::size_t begin = std::min(line.find_first_not_of(spaces), line.size());
  const std::size_t end = std::min(line.find_first_of(spaces, begin), line.size());
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

bool is_finite_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && std::isfinite(value);
}

// Whether a word is v, v/vt, v//vn or v/vt/vn with whole numbers other than 0.
bool is_corner(std::string_view word) {
  for (int field = 0; field < 3; ++field) {
    const std::string_view number = word.substr(0, word.find('/'));
    int index = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
    const bool whole = error == std::errc() && end == number.data() + number.size() && index != 0;
    const bool left_out = field == 1 && number.empty();
    if (!whole && !left_out) return false;
    if (number.size() == word.size()) return !left_out;
    word.remove_prefix(number.size() + 1);
  }
  return false;
}

// The text with its comments replaced by spaces: tinyobjloader takes a comment only on a line of
// its own.
std::string without_comments(std::string_view text) {
  std::string plain(text);
  bool comment = false;
  for (char& c : plain) {
    if (c == '#') comment = true;
    if (c == '\n' || c == '\r') comment = false;
    if (comment) c = ' ';
  }
  return plain;
}

// Throws for the lines that tinyobjloader would accept in silence: it reads a number that it cannot
// parse as 0 and skips a face without corners.
void check_lines(std::string_view text, const std::string& name) {
  std::size_t number = 0;
  while (!text.empty()) {
    ++number;
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(text.substr(end).starts_with("\r\n") ? end + 2
                                                            : std::min(end + 1, text.size()));
    const bool continued = line.ends_with('\\');
    const std::string_view key = take_word(line);
    const auto fail = [&](const std::string& what) {
      throw InputError(fmt::format("{}, line {}: {}.", name, number, what));
    };
    if (continued) fail("a line that is continued by a backslash is not supported");
    if (key == "v" || key == "vn") {
      for (int i = 0; i < 3; ++i) {
        const std::string_view word = take_word(line);
        if (word.empty()) fail(fmt::format("'{}' has fewer than three coordinates", key));
        if (!is_finite_number(word)) fail(fmt::format("'{}' is not a finite number", word));
      }
    } else if (key == "f") {
      int corners = 0;
      for (auto word = take_word(line); !word.empty(); word = take_word(line), ++corners) {
        if (!is_corner(word)) fail(fmt::format("'{}' is not a corner of a face", word));
      }
      if (corners < 3) fail(fmt::format("a face has {} corners, fewer than three", corners));
    }
  }
}

// The target of the parser's callbacks. OBJ lets a face use only what stands before it in the file,
// so every index is checked when its face arrives.
struct Reader {
  ObjFile file;
  const CountingBuffer* source = nullptr;
  const std::string* name = nullptr;

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}, line {}: {}.", *name, source->lines_read(), what));
  }

  // Turns an OBJ index, 1-based or negative and counted from the end, into a zero-based one.
  [[nodiscard]] uint32_t resolve(int index, std::size_t count, const char* what) const {
    const long long zero_based = index > 0 ? index - 1LL : static_cast<long long>(count) + index;
    if (index == 0 || zero_based < 0 || zero_based >= static_cast<long long>(count)) {
      fail(fmt::format("the face names {} {}, but there are {} so far", what, index, count));
    }
    return static_cast<uint32_t>(zero_based);
  }

  void add_face(const tinyobj::index_t* indices, int count) {
    for (int i = 0; i < count; ++i) {
      const tinyobj::index_t& index = indices[i];
      // The parser reports 0 for a normal that the face does not name; 0 is no index in OBJ.
      file.corners.push_back({resolve(index.vertex_index, file.positions.size(), "vertex"),
                              index.normal_index == 0
                                  ? ObjCorner::no_normal
                                  : resolve(index.normal_index, file.normals.size(), "normal")});
    }
    file.sizes.push_back(static_cast<uint32_t>(count));
  }
};

}  // namespace

ObjFile parse_obj(std::string_view file_text, const std::string& name) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (file_text.starts_with(byte_order_mark)) file_text.remove_prefix(byte_order_mark.size());
  const std::string text = without_comments(file_text);
  check_lines(text, name);

  CountingBuffer buffer(text);
  std::istream stream(&buffer);
  // The callbacks may throw through the parser: it holds nothing that an exception would leak.
  Reader reader{{}, &buffer, &name};
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = [](void* user, double x, double y, double z, double /*w*/) {
    static_cast<Reader*>(user)->file.positions.emplace_back(x, y, z);
  };
  callbacks.normal_cb = [](void* user, double x, double y, double z) {
    static_cast<Reader*>(user)->file.normals.emplace_back(x, y, z);
  };
  callbacks.index_cb = [](void* user, tinyobj::index_t* indices, int count) {
    static_cast<Reader*>(user)->add_face(indices, count);
  };
  std::string warning;
  std::string error;
  if (!tinyobj::LoadObjWithCallback(stream, callbacks, &reader, nullptr, &warning, &error)) {
    throw InputError(fmt::format("{}: {}", name, error));
  }
  if (reader.file.sizes.empty()) throw InputError(name + ": the file has no faces.");
  return std::move(reader.file);
}

std::string model_name(const std::filesystem::path& path) {
  return path.stem().string();
}

ObjFile read_obj(const std::filesystem::path& path) {
  std::error_code unused;
  if (std::filesystem::is_directory(path, unused)) {
    throw InputError(path.string() + ": is a directory, not an OBJ file.");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw InputError(fmt::format("{}: cannot be opened: {}.", path.string(),
                                 std::generic_category().message(errno)));
  }
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (file.bad()) throw InputError(path.string() + ": cannot be read.");
  return parse_obj(text, path.string());
}

}  // namespace trisect
