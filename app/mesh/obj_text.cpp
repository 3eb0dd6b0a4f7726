#include "app/mesh/obj_text.h"

namespace trisect {
namespace {

// UTF-16 with its mark as ASCII: only names and comments have other characters, and those do not
// matter.
std::string from_utf16(std::string_view text) {
  const std::size_t high = text.starts_with("\xFE\xFF") ? 0 : 1;
  std::string plain;
  plain.reserve(text.size() / 2);
  for (std::size_t i = 2; i + 1 < text.size(); i += 2) {
    const char low = text[i + 1 - high];
    plain.push_back(text[i + high] == '\0' && static_cast<unsigned char>(low) < 0x80 ? low : '?');
  }
  return plain;
}

}  // namespace

std::string_view take_word(std::string_view& line) {
  constexpr std::string_view spaces = " \t\r\f\v";
  const std::size_t begin = std::min(line.find_first_not_of(spaces), line.size());
  const std::size_t end = std::min(line.find_first_of(spaces, begin), line.size());
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

std::string name_in(std::string_view words) {
  const std::size_t begin = words.find_first_not_of(" \t");
  const std::size_t end = words.find_last_not_of(" \t\r");
  const bool is_named = begin != std::string_view::npos;
  return is_named ? std::string(words.substr(begin, end + 1 - begin)) : std::string();
}

std::string_view plain_text(std::string_view file_text, std::string& converted) {
  if (file_text.starts_with("\xFF\xFE") || file_text.starts_with("\xFE\xFF")) {
    converted = from_utf16(file_text);
    return converted;
  }
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (file_text.starts_with(byte_order_mark)) file_text.remove_prefix(byte_order_mark.size());
  return file_text;
}

}  // namespace trisect
