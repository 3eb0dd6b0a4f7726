// Numbers as texts that read back the same, and texts that are a number.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace trisect {

// The shortest text from which strtod() and strtold(), rounded to double, both read this value.
std::string number_text(double value);

// The number that a text is from its first character to its last, as C writes it; nothing for any
// other text, and for a number that the type cannot hold.
template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number ? std::optional(value) : std::nullopt;
}

}  // namespace trisect
