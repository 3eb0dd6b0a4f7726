// The lines of OBJ and MTL files.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace trisect {

// Removes the first word from `line` and returns it; empty at the end of the line.
std::string_view take_word(std::string_view& line);

// What is left of a line after its key: a name, which may contain spaces.
std::string name_in(std::string_view words);

// The text of a file without a byte order mark; what is in UTF-16 is put into `converted`, as
// ASCII: only names and comments have other characters.
std::string_view plain_text(std::string_view file_text, std::string& converted);

// The lines of a text, without their comments, one at a time. Where the text has a line that ends
// with a backslash the next one is its continuation; not so in a name, which may end with one.
// Names of materials and of their files may contain a #, as 3ds Max writes them.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  // False at the end of the text.
  bool next() {
    if (rest_.empty()) return false;
    number_ = passed_ + 1;
    line_ = take();
    std::string_view words = line_;
    key_ = take_word(words);
    constexpr std::array<std::string_view, 3> of_materials{"usemtl", "newmtl", "mtllib"};
    if (std::find(of_materials.begin(), of_materials.end(), key_) != of_materials.end()) {
      return true;
    }
    line_ = without_comment(line_);
    words = line_;
    key_ = take_word(words);
    constexpr std::array<std::string_view, 4> of_names{"usemap", "maplib", "o", "g"};
    if (std::find(of_names.begin(), of_names.end(), key_) != of_names.end()) return true;
    if (!is_continued(line_)) return true;
    joined_.clear();
    while (is_continued(line_)) {
      joined_.append(line_, 0, line_.rfind('\\')).push_back(' ');
      line_ = rest_.empty() ? std::string_view() : without_comment(take());
    }
    line_ = joined_.append(line_);
    words = line_;
    key_ = take_word(words);
    return true;
  }

  [[nodiscard]] std::size_t number() const { return number_; }
  [[nodiscard]] std::string_view key() const { return key_; }
  // What follows the key.
  [[nodiscard]] std::string_view words() const {
    return line_.substr(static_cast<std::size_t>(key_.data() + key_.size() - line_.data()));
  }

 private:
  static bool is_continued(std::string_view line) {
    const std::size_t last = line.find_last_not_of(" \t\r");
    return last != std::string_view::npos && line[last] == '\\';
  }

  // A line ends with \n, \r\n or a lone \r.
  std::string_view take() {
    ++passed_;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(rest_.substr(end).starts_with("\r\n") ? end + 2
                                                              : std::min(end + 1, rest_.size()));
    return line;
  }

  static std::string_view without_comment(std::string_view line) {
    return line.substr(0, line.find('#'));
  }

  std::string_view rest_;
  std::string_view line_;
  std::string_view key_;
  std::string joined_;
  std::size_t number_ = 0;
  std::size_t passed_ = 0;
};

}  // namespace trisect
