#include "app/base/message.h"

#include <gtest/gtest.h>

#include "app/base/error.h"
#include "app/base/read_file.h"

namespace trisect {
namespace {

TEST(Escaped, ShowsWhatATerminalWouldTakeForSomethingElse) {
  EXPECT_EQ(escaped("plain, \xC3\xA9 \xE2\x82\xAC \xF0\x9F\x98\x80"),
            "plain, \xC3\xA9 \xE2\x82\xAC \xF0\x9F\x98\x80");
  EXPECT_EQ(escaped("a\nb\tc\x1b[31m\x7f"), "a\\x0ab\\x09c\\x1b[31m\\x7f");
  EXPECT_EQ(escaped(std::string("\0", 1)), "\\x00");
  // No UTF-8: a lone byte, a character cut off, one written too long, a surrogate, one too large.
  EXPECT_EQ(escaped("\xFF"), "\\xff");
  EXPECT_EQ(escaped("\xE2\x82"), "\\xe2\\x82");
  EXPECT_EQ(escaped("\xC0\xAF"), "\\xc0\\xaf");
  EXPECT_EQ(escaped("\xE0\x80\xAF"), "\\xe0\\x80\\xaf");
  EXPECT_EQ(escaped("\xED\xA0\x80"), "\\xed\\xa0\\x80");
  EXPECT_EQ(escaped("\xF4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
  // Control characters of Unicode: the next line, the end of a line, the turn of writing.
  EXPECT_EQ(escaped("\xC2\x85"), "\\xc2\\x85");
  EXPECT_EQ(escaped("\xE2\x80\xA8"), "\\xe2\\x80\\xa8");
  EXPECT_EQ(escaped("\xE2\x80\xAE"), "\\xe2\\x80\\xae");
  EXPECT_EQ(escaped_lines("a\nb\x1b\n"), "a\nb\\x1b\n");
}

TEST(ReasonOf, IsOnOneLineWithoutAFullStop) {
  EXPECT_EQ(reason_of(" the file\n  is short.. \n"), "the file is short");
  EXPECT_EQ(reason_of("\n"), "it is damaged");
  EXPECT_EQ(reason_of("", "nothing"), "nothing");
}

TEST(MessageLine, IsOneShortLine) {
  EXPECT_EQ(message_line("trisect: a.obj: is empty."), "trisect: a.obj: is empty.");
  EXPECT_EQ(message_line("it is so.."), "it is so.");
  EXPECT_EQ(message_line(""), "");
  // Of a long word the ends are left, and the sentence around it.
  std::string word = "x";
  while (word.size() < 100000000) word += word;
  const std::string line = message_line("a.obj, line 3: '" + word + "' is not a number.");
  EXPECT_TRUE(line.starts_with("a.obj, line 3: 'xxx")) << line;
  EXPECT_TRUE(line.ends_with("xxx' is not a number.")) << line;
  EXPECT_NE(line.find("x...x"), std::string::npos) << line;
  EXPECT_LE(line.size(), kMessageBytes);
}

TEST(MessageLine, IsCutBetweenCharacters) {
  for (std::size_t shift = 0; shift < 8; ++shift) {
    std::string text(shift, 'a');
    for (int i = 0; i < 5000; ++i) text += "\xF0\x9F\x98\x80";
    const std::string line = message_line(text);
    EXPECT_EQ(escaped(line), line);
    EXPECT_EQ(line.find('\\'), std::string::npos) << line;
    EXPECT_LE(line.size(), kMessageBytes);
  }
  // Bytes that are shown as four are not cut in these either.
  const std::string line = message_line(std::string(5000, '\x1b'));
  EXPECT_TRUE(line.starts_with("\\x1b\\x1b"));
  EXPECT_TRUE(line.ends_with("b\\x1b"));
  // Many short words.
  std::string words = "begin";
  for (int i = 0; i < 1000; ++i) words += " word";
  const std::string cut = message_line(words + " end.");
  EXPECT_TRUE(cut.starts_with("begin word")) << cut;
  EXPECT_TRUE(cut.ends_with("word end.")) << cut;
  EXPECT_LE(cut.size(), kMessageBytes);
}

TEST(ReadFile, SaysWhyItCannot) {
  const auto message_of = [](const char* path) -> std::string {
    try {
      read_file(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message_of("/nonexistent"),
            "/nonexistent: cannot be opened: No such file or directory.");
  EXPECT_EQ(message_of("/"), "/: cannot be read: it is a directory.");
  EXPECT_EQ(message_of("/proc/self/mem"), "/proc/self/mem: cannot be read: Input/output error.");
  EXPECT_EQ(read_file("/dev/null"), "");
  // Its size is said to be 0.
  EXPECT_FALSE(read_file("/proc/self/maps").empty());
}

}  // namespace
}  // namespace trisect
