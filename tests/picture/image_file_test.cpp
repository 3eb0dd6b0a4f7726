#include "app/picture/image_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <png.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/base/srgb.h"
#include "app/picture/image_channels.h"
#include "app/picture/image_reader.h"
#include "tests/support/exr_reader.h"
#include "tests/support/file_content.h"
#include "tests/support/peak_memory.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

// Five by three pixels, every number of every pixel different.
Frame sample(bool aovs) {
  Frame frame;
  frame.width = 5;
  frame.height = 3;
  for (uint32_t i = 0; i < 15; ++i) {
    const float x = static_cast<float>(i) / 15.0F;
    frame.colors.emplace_back(x, 1.0F - x, x * x, i % 2 == 0 ? 1.0F : 0.0F);
    if (!aovs) continue;
    PixelAovs aov{};
    aov.normal_z = vec4(x, x + 1.0F, x + 2.0F, x + 3.0F);
    aov.geometric_u = vec4(x + 4.0F, x + 5.0F, x + 6.0F, x + 7.0F);
    aov.v = x + 8.0F;
    aov.triangle = i == 3 ? NO_TRIANGLE : 1000000U + i;
    frame.aovs.push_back(aov);
  }
  return frame;
}

TEST(ImageFormat, FollowsTheEnding) {
  EXPECT_EQ(image_format("a/b.png"), ImageFormat::png);
  EXPECT_EQ(image_format("b.EXR"), ImageFormat::exr);
  for (const char* name : {"b.jpg", "b", "png", ".png"}) {
    EXPECT_THROW(image_format(name), UsageError) << name;
  }
}

TEST(Srgb, DecodesTheStandardsValues) {
  EXPECT_EQ(linear_from_srgb(0.0F), 0.0F);
  EXPECT_EQ(linear_from_srgb(1.0F), 1.0F);
  EXPECT_NEAR(linear_from_srgb(0.04F), 0.04F / 12.92F, 1e-9F);
  // Half grey: 0.2140411 in IEC 61966-2-1's function.
  EXPECT_NEAR(linear_from_srgb(0.5F), 0.2140411F, 1e-7F);
}

// A pixel of which a quarter of the rays met something red has that red, and a quarter for alpha.
TEST(WritePng, WritesColoursThatAreNotMultipliedWithAlpha) {
  const test::TemporaryFolder folder;
  Frame frame;
  frame.resize(3, 1, false);
  frame.colors = {vec4(0.8F, 0.4F, 0.0F, 1.0F), vec4(0.0F), vec4(0.0F)};
  for (int k = 0; k < 3; ++k) {
    frame.colors[1][k] = srgb_from_linear(linear_from_srgb(frame.colors[0][k]) * 0.25F);
  }
  frame.colors[1].w = 0.25F;
  AtomicFile file(folder / "a.png");
  write_png(frame, file, {.alpha = true});
  file.commit();

  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&image, (folder / "a.png").c_str()), 0);
  EXPECT_EQ(image.format & PNG_FORMAT_FLAG_ALPHA, PNG_FORMAT_FLAG_ALPHA);
  image.format = PNG_FORMAT_RGBA;
  std::vector<uint8_t> bytes(PNG_IMAGE_SIZE(image));
  ASSERT_NE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr), 0);
  EXPECT_EQ(bytes, (std::vector<uint8_t>{204, 102, 0, 255, 204, 102, 0, 64, 0, 0, 0, 0}));
}

TEST(WritePng, WritesTheFramesBytesRowByRow) {
  const test::TemporaryFolder folder;
  const Frame frame = sample(false);
  AtomicFile file(folder / "a.png");
  write_png(frame, file);
  file.commit();

  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&image, (folder / "a.png").c_str()), 0);
  EXPECT_EQ(image.width, 5U);
  EXPECT_EQ(image.height, 3U);
  // Marked as sRGB: no flag says that it is not.
  EXPECT_EQ(image.flags & PNG_IMAGE_FLAG_COLORSPACE_NOT_sRGB, 0U);
  image.format = PNG_FORMAT_RGB;
  std::vector<uint8_t> bytes(PNG_IMAGE_SIZE(image));
  ASSERT_NE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr), 0);
  for (std::size_t i = 0; i < 15; ++i) {
    for (int k = 0; k < 3; ++k) {
      const float exact = frame.colors[i][k] * 255.0F;
      EXPECT_NEAR(static_cast<float>(bytes[3 * i + static_cast<std::size_t>(k)]), exact, 0.501F);
    }
  }
}

// PFM's rows go from the lowest up.
TEST(WritePfm, WritesColoursOrOneOutput) {
  const test::TemporaryFolder folder;
  const Frame frame = sample(true);
  const auto written = [&](Aov aov, const std::string& head, std::size_t components) {
    ImageContents contents;
    contents.aovs = {aov};
    contents.position = [&](uint32_t x, uint32_t y) { return glm::vec3(frame.colors[y * 5 + x]); };
    save_image(frame, folder / "a.pfm", contents);
    const std::string bytes = test::content_of(folder / "a.pfm");
    EXPECT_EQ(bytes.substr(0, head.size()), head);
    std::vector<float> numbers(15 * components);
    EXPECT_EQ(bytes.size(), head.size() + numbers.size() * sizeof(float));
    std::memcpy(numbers.data(), bytes.data() + head.size(), numbers.size() * sizeof(float));
    return numbers;
  };
  const std::string three = "PF\n5 3\n-1.0\n";
  const std::size_t lowest = 10;
  EXPECT_EQ(written(Aov::color, three, 3)[1], linear_from_srgb(frame.colors[lowest].y));
  EXPECT_EQ(written(Aov::color, three, 3)[44], linear_from_srgb(frame.colors[4].z));
  EXPECT_EQ(written(Aov::depth, "Pf\n5 3\n-1.0\n", 1)[2], frame.aovs[lowest + 2].normal_z.w);
  EXPECT_EQ(written(Aov::normal, three, 3)[2], frame.aovs[lowest].normal_z.z);
  EXPECT_EQ(written(Aov::geometric, three, 3)[0], frame.aovs[lowest].geometric_u.x);
  EXPECT_EQ(written(Aov::position, three, 3)[15], frame.colors[5].x);
}

// A picture may be as large as the memory: what is written of it is made row by row.
TEST(Memory, OfAPictureIsItsFrameWhenItIsWritten) {
  const test::TemporaryFolder folder;
  const test::PeakMemory of_frame;
  Frame frame;
  frame.resize(1000, 4000, true);
  EXPECT_GT(of_frame.bytes(), 60.0 * 1000 * 4000) << "the peak was not measured";
  ImageContents contents;
  contents.position = [](uint32_t x, uint32_t y) { return glm::vec3(x, y, 0.0F); };
  for (const char* name : {"a.png", "a.exr", "a.pfm"}) {
    contents.aovs = {Aov::position};
    if (image_format(name) == ImageFormat::exr) contents.aovs.push_back(Aov::color);
    const test::PeakMemory peak;
    save_image(frame, folder / name, contents);
    // The bytes of a PNG would take three a pixel, positions twelve. The libraries' own memory is a
    // few megabytes the first time.
    EXPECT_LT(peak.bytes(), 2.0 * 1000 * 4000) << name;
  }
}

// Every kind of attribute comes back as its text, whatever the letters.
TEST(ReadAttributes, FindsWhatWasWritten) {
  const test::TemporaryFolder folder;
  const double unusual = 0.1234567890123456789e-7;
  ImageContents contents;
  contents.attributes = {{"model", std::string("M\xc3\xb6"
                                               "bel \"1\".obj")},
                         {"rank", 7},
                         {"alpha", unusual},
                         {"eye", glm::dvec3(0.1, -2.0, 1e300)}};
  for (const char* name : {"a.png", "a.exr"}) {
    save_image(sample(false), folder / name, contents);
    std::map<std::string, std::string> said;
    for (const auto& [key, value] : read_attributes(folder / name)) said[key] = value;
    EXPECT_EQ(said["model"],
              "M\xc3\xb6"
              "bel \"1\".obj")
        << name;
    EXPECT_EQ(said["rank"], "7");
    EXPECT_EQ(std::strtod(said["alpha"].c_str(), nullptr), unusual);
    EXPECT_EQ(said["eye"], "0.1,-2,1e+300");
  }
}

// Other programs have meanings of their own for "background", "model" or "date".
TEST(WritePng, NamesItsTextsApart) {
  const test::TemporaryFolder folder;
  ImageContents contents;
  contents.attributes = {{"background", std::string("sky")}};
  save_image(sample(false), folder / "a.png", contents);
  const std::string bytes = test::content_of(folder / "a.png");
  EXPECT_NE(bytes.find(std::string("tEXttrisect:background\0sky", 26)), std::string::npos);
}

TEST(WriteExr, NamesThePrimariesOfSrgb) {
  const test::TemporaryFolder folder;
  save_image(sample(false), folder / "a.exr");
  const std::vector<float> rec_709{0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};
  EXPECT_EQ(test::exr_chromaticities(folder / "a.exr"), rec_709);
}

TEST(WriteExr, KeepsEveryChannel) {
  const test::TemporaryFolder folder;
  const Frame frame = sample(true);
  AtomicFile file(folder / "a.exr");
  write_exr(frame, file);
  file.commit();

  const std::map<std::string, std::string> expected{
      {"R", "float"},   {"G", "float"},   {"B", "float"},   {"A", "float"},   {"Z", "float"},
      {"N.X", "float"}, {"N.Y", "float"}, {"N.Z", "float"}, {"G.X", "float"}, {"G.Y", "float"},
      {"G.Z", "float"}, {"U", "float"},   {"V", "float"},   {"patch", "uint"}};
  EXPECT_EQ(test::exr_channels(folder / "a.exr"), expected);

  const Frame read = test::read_exr(folder / "a.exr");
  ASSERT_EQ(read.width, 5U);
  ASSERT_EQ(read.height, 3U);
  for (std::size_t i = 0; i < 15; ++i) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(read.colors[i][k], linear_from_srgb(frame.colors[i][k]));
    }
    EXPECT_EQ(read.colors[i].w, frame.colors[i].w);
    EXPECT_EQ(read.aovs[i].normal_z, frame.aovs[i].normal_z);
    EXPECT_EQ(read.aovs[i].geometric_u, frame.aovs[i].geometric_u);
    EXPECT_EQ(read.aovs[i].v, frame.aovs[i].v);
    EXPECT_EQ(read.aovs[i].triangle, frame.aovs[i].triangle);
  }
}

// More rows than are written at once, of a part of an image.
TEST(WriteExr, KeepsEveryRow) {
  const test::TemporaryFolder folder;
  Frame frame;
  frame.resize(3, 200, true);
  for (std::size_t i = 0; i < frame.colors.size(); ++i) {
    frame.colors[i] = vec4(static_cast<float>(i) / 600.0F);
    frame.aovs[i].normal_z = vec4(static_cast<float>(i));
  }
  ImageContents contents;
  contents.place = FramePlace{7, 11, 20, 300};
  contents.aovs.push_back(Aov::position);
  contents.position = [](uint32_t x, uint32_t y) { return glm::vec3(x, y, 5.0F); };
  save_image(frame, folder / "a.exr", contents);
  const ImageChannels channels(folder / "a.exr");
  const auto expect_all = [&](const char* name, auto&& expected) {
    const std::vector<uint32_t> bits = channels.bits(name);
    ASSERT_EQ(bits.size(), 600U);
    for (std::size_t i = 0; i < 600; ++i) {
      EXPECT_EQ(std::bit_cast<float>(bits[i]), expected(i)) << name << " " << i;
    }
  };
  expect_all("R", [&](std::size_t i) { return linear_from_srgb(frame.colors[i].x); });
  expect_all("Z", [](std::size_t i) { return static_cast<float>(i); });
  expect_all("P.Y", [](std::size_t i) {
    const std::size_t row = i / 3;
    return static_cast<float>(row);
  });
}

TEST(AtomicFile, AppearsWholeOrNotAtAll) {
  const test::TemporaryFolder folder;
  const auto entries = [&] {
    return std::distance(std::filesystem::directory_iterator(folder.path()), {});
  };
  {
    const AtomicFile file(folder / "a.txt");
    file.write("half");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.txt"));
  }
  EXPECT_EQ(entries(), 0);
  {
    AtomicFile file(folder / "a.txt");
    file.write("whole");
    file.commit();
  }
  EXPECT_EQ(entries(), 1);
  std::string text;
  std::ifstream(folder / "a.txt") >> text;
  EXPECT_EQ(text, "whole");
}

// Whether files of that folder can be without a name.
bool has_unnamed_files(const std::filesystem::path& folder) {
  const int file = open(folder.c_str(), O_TMPFILE | O_RDWR, 0600);
  if (file >= 0) close(file);
  return file >= 0;
}

// A process that is killed while it writes leaves nothing behind.
TEST(AtomicFile, HasNoNameUntilItIsWhole) {
  const test::TemporaryFolder folder;
  const auto names = [&] {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      found.push_back(entry.path().filename());
    }
    return found;
  };
  for (const char* text : {"first", "second"}) {
    const std::vector<std::string> before = names();
    AtomicFile file(folder / "a.txt");
    file.write(text);
    if (has_unnamed_files(folder.path())) {
      EXPECT_EQ(names(), before);
    }
    file.commit();
    EXPECT_EQ(names(), std::vector<std::string>{"a.txt"});
    EXPECT_EQ(test::content_of(folder / "a.txt"), text);
  }
}

// As long as a name can be.
TEST(AtomicFile, TakesLongNames) {
  const test::TemporaryFolder folder;
  const std::string name(255, 'a');
  for (int i = 0; i < 2; ++i) {
    AtomicFile file(folder / name);
    file.write("text");
    file.commit();
    EXPECT_EQ(test::content_of(folder / name), "text");
  }
  EXPECT_THROW(AtomicFile(folder / (name + "a")).commit(), InputError);
}

TEST(AtomicFile, KeepsLinksAndPermissions) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "real.txt") << "old";
  using std::filesystem::perms;
  const perms mode = perms::owner_read | perms::owner_write | perms::group_read;
  std::filesystem::permissions(folder / "real.txt", mode);
  std::filesystem::create_symlink("real.txt", folder / "link.txt");
  AtomicFile file(folder / "link.txt");
  file.write("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
  EXPECT_EQ(std::filesystem::status(folder / "real.txt").permissions(), mode);
  std::string text;
  std::ifstream(folder / "real.txt") >> text;
  EXPECT_EQ(text, "new");
}

TEST(AtomicFile, RefusesAtOnceWhatCannotBeWritten) {
  const test::TemporaryFolder folder;
  // What is no regular file must not be replaced by one.
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(AtomicFile(folder / "pipe"), InputError);
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
  EXPECT_THROW(AtomicFile(folder / "no-such-folder" / "a.txt"), InputError);
  EXPECT_THROW(AtomicFile(folder.path()), InputError);
}

}  // namespace
}  // namespace trisect
