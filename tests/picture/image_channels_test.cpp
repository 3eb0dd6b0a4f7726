// What two image files must have in common to be equal, channel by channel.
#include "app/picture/image_channels.h"

#include <gtest/gtest.h>
#include <png.h>

#include <bit>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "app/base/error.h"
#include "app/base/srgb.h"
#include "app/picture/image_reader.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

struct PngFormat {
  int bits;
  int color_type;
  int interlace = PNG_INTERLACE_NONE;
  double gamma = 0.0;  // none is written
};

// A file of 2 x 2 pixels with these bytes, one after the other.
void write_small_png(const std::string& path, const PngFormat& format, std::vector<uint8_t> bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, 2, 2, format.bits, format.color_type, format.interlace,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (format.gamma > 0.0) png_set_gAMA(png, info, format.gamma);
  std::vector<uint8_t*> rows{bytes.data(), bytes.data() + bytes.size() / 2};
  png_set_rows(png, info, rows.data());
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

// The same four colours in every format of PNG that can hold them.
TEST(ImageChannels, OfPngAreTheNumbersThatItHas) {
  const test::TemporaryFolder folder;
  const std::vector<uint8_t> grey{0, 51, 102, 255};
  const std::vector<uint32_t> expected{0, 51 * 257, 102 * 257, 65535};
  std::vector<uint8_t> rgb;
  std::vector<uint8_t> rgba;
  std::vector<uint8_t> wide;
  for (const uint8_t value : grey) {
    rgb.insert(rgb.end(), 3, value);
    rgba.insert(rgba.end(), {value, value, value, 77});
    wide.insert(wide.end(), 6, value);
  }
  const std::string path = folder / "a.png";
  for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
    for (const auto& [format, bytes] :
         {std::pair(PngFormat{8, PNG_COLOR_TYPE_GRAY, interlace}, grey),
          {PngFormat{8, PNG_COLOR_TYPE_RGB, interlace}, rgb},
          {PngFormat{8, PNG_COLOR_TYPE_RGB, interlace, 0.45455}, rgb},
          {PngFormat{8, PNG_COLOR_TYPE_RGB_ALPHA, interlace}, rgba},
          {PngFormat{16, PNG_COLOR_TYPE_RGB, interlace}, wide}}) {
      write_small_png(path, format, bytes);
      const bool alpha = format.color_type == PNG_COLOR_TYPE_RGB_ALPHA;
      EXPECT_EQ(ImageChannels(path).names(), alpha ? (std::vector<std::string>{"A", "B", "G", "R"})
                                                   : (std::vector<std::string>{"B", "G", "R"}));
      for (const char* name : {"R", "G", "B"}) EXPECT_EQ(ImageChannels(path).bits(name), expected);
      if (alpha) {
        EXPECT_EQ(ImageChannels(path).bits("A"), std::vector<uint32_t>(4, 77 * 257));
      }
      const Frame frame = read_image(path);
      EXPECT_EQ(frame.colors[1], vec4(0.2F, 0.2F, 0.2F, alpha ? 77.0F / 255.0F : 1.0F));
    }
  }
  // 16 bits are not cut to 8.
  write_small_png(path, {16, PNG_COLOR_TYPE_GRAY}, {0, 0, 0, 1, 1, 2, 255, 254});
  EXPECT_EQ(ImageChannels(path).bits("G"), (std::vector<uint32_t>{0, 1, 258, 65534}));
}

// Colours in linear light, which the file says they are, become sRGB. libpng takes a power of 2.2
// for sRGB's curve: from it that is up to 0.0085 off, and below 0.04 more.
TEST(ImageChannels, OfPngInLinearLightBecomeSrgb) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "a.png";
  write_small_png(path, {16, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, 1.0},
                  {0, 0, 64, 0, 128, 0, 255, 255});
  const Frame frame = read_image(path);
  EXPECT_EQ(frame.colors[0].x, 0.0F);
  EXPECT_NEAR(frame.colors[1].x, srgb_from_linear(64.0F / 256.0F), 0.0085F);
  EXPECT_NEAR(frame.colors[2].x, srgb_from_linear(128.0F / 256.0F), 0.0085F);
  EXPECT_EQ(frame.colors[3].x, 1.0F);
}

TEST(ImageChannels, OfExrAreTheBitsOfItsNumbers) {
  const test::TemporaryFolder folder;
  const std::string path = folder / "a.exr";
  Frame frame;
  frame.resize(3, 2, true);
  for (uint32_t i = 0; i < 6; ++i) {
    frame.aovs[i] = PixelAovs{};
    frame.aovs[i].triangle = 1000 + i;
    frame.aovs[i].v = 0.1F * static_cast<float>(i);
  }
  frame.aovs[4].v = std::numeric_limits<float>::quiet_NaN();
  {
    AtomicFile file(path);
    write_exr(frame, file);
    file.commit();
  }
  EXPECT_EQ(ImageChannels(path).bits("patch"),
            (std::vector<uint32_t>{1000, 1001, 1002, 1003, 1004, 1005}));
  const std::vector<uint32_t> bits = ImageChannels(path).bits("V");
  for (uint32_t i = 0; i < 6; ++i) {
    EXPECT_EQ(bits[i], std::bit_cast<uint32_t>(frame.aovs[i].v)) << i;
  }
  EXPECT_FALSE(read_window(path));
}

TEST(ImageChannels, OfPartsAreInAWindow) {
  const test::TemporaryFolder folder;
  Frame frame;
  frame.resize(3, 2, false);
  ImageContents contents;
  contents.place = FramePlace{4, 5, 30, 20};
  contents.attributes = {{"size", std::string("30x20")}, {"tile", std::string("4,5,3,2")}};
  for (const std::string name : {"a.png", "a.exr"}) {
    AtomicFile file(folder / name);
    write_image(frame, image_format(name), file, contents);
    file.commit();
    EXPECT_EQ(read_window(folder / name), (ImageWindow{4, 5, 30, 20})) << name;
    EXPECT_EQ(window_text(read_window(folder / name)), "at 4,5 in an image of 30x20");
  }
  EXPECT_THROW(read_window(folder / "none.exr"), InputError);
  EXPECT_THROW(ImageChannels(folder / "none.png"), InputError);
}

}  // namespace
}  // namespace trisect
