#include <sstream>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/judge/ray_file.h"
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

// A list of rays, or of hits.
void read_ray_lists(const std::string& name, Bytes content) {
  const std::filesystem::path file = write_input(name, content);
  expect_answer([&] {
    const std::vector<FileRay> rays = read_rays(file);
    expect(!rays.empty(), "no rays");
    for (const FileRay& ray : rays) {
      expect(glm::length(ray.direction) > 0.0 && ray.t_min <= ray.t_max, "a ray that is none");
    }
  });
  expect_answer([&] {
    const std::vector<FileHit> hits = read_hits(file);
    const std::string again = hits_for(name, hits);
    write_input(name, Bytes(reinterpret_cast<const uint8_t*>(again.data()), again.size()));
    expect(read_hits(file).size() == hits.size(),
           "hits that are not read back as they were written");
  });
}

}  // namespace

void text_input(Bytes input) {
  if (input.empty()) return;
  const std::string text = text_of(input.subspan(1));
  switch (input[0] % 6) {
    case 0:
      return parse_command_line(text);
    case 1:
      return read_flags(text);
    case 2:
      write_input("script", input.subspan(1));
      return expect_answer([] { view::read_script((input_folder() / "script").string()); });
    case 3:
      return parse_values(text);
    default:
      return read_ray_lists(input[0] % 6 == 4 ? "list.csv" : "list", input.subspan(1));
  }
}

}  // namespace trisect::fuzz
