#include "app/base/message.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace trisect {
namespace {

constexpr std::string_view kEllipsis = "...";
// A word may keep so many bytes where a message is too long.
constexpr std::size_t kWordBytes = 90;
// Of a text that is longer only the ends are looked at.
constexpr std::size_t kTextBytes = 4096;

bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

// The bytes of the character of UTF-8 that a text begins with, 0 if it begins with none. Sets
// `code` to it.
std::size_t character_at(std::string_view text, uint32_t& code) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t size = first < 0x80   ? 1
                           : first < 0xC2 ? 0
                           : first < 0xE0 ? 2
                           : first < 0xF0 ? 3
                           : first < 0xF5 ? 4
                                          : 0;
  if (size == 0 || size > text.size()) return 0;
  code = size == 1 ? first : first & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if (!is_continuation(text[i])) return 0;
    code = code << 6U | (static_cast<unsigned char>(text[i]) & 0x3FU);
  }
  const bool is_too_long = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  return is_too_long || is_surrogate || code > 0x10FFFF ? 0 : size;
}

bool is_shown(uint32_t code) {
  const bool is_control = code < 0x20 || (code >= 0x7F && code <= 0x9F);
  const bool turns_writing = code == 0x200E || code == 0x200F || code == 0x61C ||
                             (code >= 0x202A && code <= 0x202E) ||
                             (code >= 0x2066 && code <= 0x2069);
  const bool ends_line = code == 0x2028 || code == 0x2029;
  return !is_control && !turns_writing && !ends_line && code != 0xFEFF;
}

// Calls take(piece) for each character or escaped byte.
template <typename Take>
void for_each_piece(std::string_view text, Take&& take) {
  while (!text.empty()) {
    uint32_t code = 0;
    const std::size_t size = character_at(text, code);
    if (size > 0 && is_shown(code)) {
      take(text.substr(0, size));
      text.remove_prefix(size);
      continue;
    }
    for (std::size_t i = 0; i < std::max<std::size_t>(size, 1); ++i) {
      take(std::string_view(fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i]))));
    }
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
}

using Pieces = std::vector<std::string>;

std::size_t bytes_of(const Pieces& pieces, std::size_t begin, std::size_t end) {
  std::size_t bytes = 0;
  for (std::size_t i = begin; i < end; ++i) bytes += pieces[i].size();
  return bytes;
}

// Puts an ellipsis in the middle of the pieces from begin to end, so that they have no more than so
// many bytes.
Pieces shortened(const Pieces& pieces, std::size_t begin, std::size_t end, std::size_t most) {
  const auto at = [&](std::size_t i) { return pieces.begin() + static_cast<std::ptrdiff_t>(i); };
  if (bytes_of(pieces, begin, end) <= most) return {at(begin), at(end)};
  const std::size_t kept = most - kEllipsis.size();
  std::size_t head = begin;
  for (std::size_t bytes = 0; bytes + pieces[head].size() <= kept / 2; ++head) {
    bytes += pieces[head].size();
  }
  std::size_t tail = end;
  for (std::size_t bytes = 0; bytes + pieces[tail - 1].size() <= kept / 2; --tail) {
    bytes += pieces[tail - 1].size();
  }
  Pieces result(at(begin), at(head));
  result.emplace_back(kEllipsis);
  result.insert(result.end(), at(tail), at(end));
  return result;
}

// Shortens the words that are long themselves.
Pieces with_short_words(const Pieces& pieces) {
  Pieces result;
  for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
    while (end < pieces.size() && pieces[end] != " ") ++end;
    const Pieces word = shortened(pieces, begin, end, kWordBytes);
    result.insert(result.end(), word.begin(), word.end());
    if (end < pieces.size()) result.push_back(pieces[end++]);
  }
  return result;
}

// The ends of a text that is far too long, cut between characters.
std::string ends_of(std::string_view text) {
  if (text.size() <= kTextBytes) return std::string(text);
  std::size_t head = kTextBytes / 2;
  while (head > 0 && is_continuation(text[head])) --head;
  std::size_t tail = text.size() - kTextBytes / 2;
  while (tail < text.size() && is_continuation(text[tail])) ++tail;
  return fmt::format("{}{}{}", text.substr(0, head), kEllipsis, text.substr(tail));
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for_each_piece(text, [&](std::string_view piece) { result += piece; });
  return result;
}

std::string escaped_lines(std::string_view text) {
  std::string result;
  while (true) {
    const std::size_t end = text.find('\n');
    result += escaped(text.substr(0, end));
    if (end == std::string_view::npos) return result;
    result += '\n';
    text.remove_prefix(end + 1);
  }
}

std::string reason_of(std::string_view text, std::string_view otherwise) {
  constexpr std::string_view spaces = " \t\r\n\v\f";
  std::string reason;
  for (const char c : text) {
    const bool is_space = spaces.find(c) != std::string_view::npos;
    if (!is_space) reason += c;
    if (is_space && !reason.empty() && reason.back() != ' ') reason += ' ';
  }
  while (!reason.empty() && (reason.back() == ' ' || reason.back() == '.')) reason.pop_back();
  return reason.empty() ? std::string(otherwise) : reason;
}

std::string message_line(std::string_view text) {
  Pieces pieces;
  for_each_piece(ends_of(text), [&](std::string_view piece) { pieces.emplace_back(piece); });
  if (bytes_of(pieces, 0, pieces.size()) > kMessageBytes) pieces = with_short_words(pieces);
  pieces = shortened(pieces, 0, pieces.size(), kMessageBytes);
  std::string line = fmt::format("{}", fmt::join(pieces, ""));
  while (line.ends_with("..")) line.pop_back();
  return line;
}

}  // namespace trisect
