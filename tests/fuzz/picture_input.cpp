#include <algorithm>
#include <string>
#include <vector>

#include "app/cli/render_options.h"
#include "app/picture/image_reader.h"
#include "app/picture/stitch.h"
#include "tests/fuzz/answers.h"

namespace trisect::fuzz {
namespace {

namespace fs = std::filesystem;

void look_at_picture(const fs::path& path) {
  expect_answer([&] { read_attributes(path); });
  expect_answer([&] { saved_options(path.string()); });
  expect_answer([&] {
    const Frame frame = read_image(path);
    const std::size_t pixels = std::size_t{frame.width} * frame.height;
    expect(frame.colors.size() == pixels, "not a colour for each pixel");
    expect(frame.aovs.empty() || frame.aovs.size() == pixels, "not AOVs for each pixel");
  });
  is_whole_image(path);
}

}  // namespace

void picture_input(Bytes input) {
  Numbers numbers(input);
  const auto choice = numbers.next<uint8_t>();
  const bool is_png = choice % 2 == 0;
  const bool are_two = choice / 2 % 2 == 1;
  Bytes content = input.subspan(std::min<std::size_t>(input.size(), 1));
  const std::string ending = is_png ? ".png" : ".exr";
  std::vector<fs::path> parts;
  if (are_two) {
    const std::size_t first = numbers.next<uint16_t>();
    content = content.subspan(std::min<std::size_t>(content.size(), 2));
    const std::size_t size = std::min(first, content.size());
    parts.push_back(write_input("first" + ending, content.first(size)));
    content = content.subspan(size);
  }
  parts.push_back(write_input("last" + ending, content));
  for (const fs::path& part : parts) look_at_picture(part);
  expect_answer([&] {
    AtomicFile whole(input_folder() / ("whole" + ending));
    stitch(parts, is_png ? ImageFormat::png : ImageFormat::exr, whole);
    whole.commit();
    expect(is_whole_image(whole.target()), "a stitched picture that cannot be read");
  });
}

}  // namespace trisect::fuzz
