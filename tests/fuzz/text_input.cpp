#include <sstream>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/program/command_line.h"
#include "app/view/flags.h"
#include "app/view/script.h"
#include "tests/fuzz/answers.h"

namespace trisect::fuzz {
namespace {

// One word a line.
void parse_command_line(const std::string& text) {
  std::vector<std::string> words{"trisect"};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) words.emplace_back(line.c_str());
  std::vector<const char*> arguments;
  arguments.reserve(words.size());
  for (const std::string& word : words) arguments.push_back(word.c_str());
  expect_answer([&] { CommandLine().parse(static_cast<int>(arguments.size()), arguments.data()); });
}

void read_flags(const std::string& text) {
  expect_answer([&] {
    const std::string flags = view::flags_of(view::with_flags({}, text));
    expect(view::flags_of(view::with_flags({}, flags)) == flags,
           "flags that are not read back: " + flags);
  });
}

void parse_values(const std::string& text) {
  expect_answer([&] {
    uint32_t width = 0;
    uint32_t height = 0;
    parse_size("--size", text, width, height);
    expect(width > 0 && height > 0, "a size of nothing");
  });
  expect_answer([&] { parse_triple("--eye", text); });
  expect_answer([&] { parse_direction("--light", text); });
  expect_answer([&] { parse_color("--color", text); });
  expect_answer([&] { aovs_text(parse_aovs("--aov", text)); });
  expect_answer([&] { parse_frames("--frames", text); });
  expect_answer([&] {
    const ImagePart part = parse_part("--tile", text, 800, 600);
    expect(part.is_in(800, 600), "a part outside of its image");
  });
  expect_answer([&] { parse_backends("--backends", text); });
  expect_answer([&] {
    Tolerance tolerance;
    parse_threshold("--threshold", text, tolerance);
  });
}

}  // namespace

void text_input(Bytes input) {
  if (input.empty()) return;
  const std::string text = text_of(input.subspan(1));
  switch (input[0] % 4) {
    case 0:
      return parse_command_line(text);
    case 1:
      return read_flags(text);
    case 2:
      write_input("script", input.subspan(1));
      return expect_answer([] { view::read_script((input_folder() / "script").string()); });
    default:
      return parse_values(text);
  }
}

}  // namespace trisect::fuzz
