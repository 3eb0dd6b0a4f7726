// Texts for a person that may hold bytes of files, of options and of libraries.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trisect {

// The most bytes that message_line() returns.
inline constexpr std::size_t kMessageBytes = 300;

// The text with \xNN for each byte that a terminal may take for something other than a character to
// show: control characters, what is not UTF-8, and the characters of Unicode that end a line or
// turn the direction of writing.
std::string escaped(std::string_view text);

// The same, but lines stay lines.
std::string escaped_lines(std::string_view text);

// What a library says is wrong, to be put into a sentence: on one line, without a full stop at the
// end. `otherwise` if it says nothing.
std::string reason_of(std::string_view text, std::string_view otherwise = "it is damaged");

// A message as the program prints it: one line of at most kMessageBytes bytes, escaped, without a
// full stop after another. Of what is too long the middle gives way to "...": first that of words
// that are long themselves.
std::string message_line(std::string_view text);

}  // namespace trisect
