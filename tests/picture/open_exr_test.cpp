// Attributes of a header that have not the bytes of their type, for which OpenEXR reads on where
// nothing is theirs.
#include "app/picture/open_exr.h"

#include <ImfBoxAttribute.h>
#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfDoubleAttribute.h>
#include <ImfEnvmapAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfKeyCodeAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfPreviewImageAttribute.h>
#include <ImfRationalAttribute.h>
#include <ImfStringAttribute.h>
#include <ImfStringVectorAttribute.h>
#include <ImfTimeCodeAttribute.h>
#include <ImfVecAttribute.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/file_content.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

// A header with a value of every type that a file of rows can have, and the three of a list.
Imf::Header header_of_every_type() {
  Imf::Header header(1, 1);
  header.channels().insert("R", Imf::Channel(Imf::HALF));
  header.channels().insert("G", Imf::Channel(Imf::HALF));
  header.insert("a box2f", Imf::Box2fAttribute());
  header.insert("a box2i", Imf::Box2iAttribute());
  header.insert("a chromaticities", Imf::ChromaticitiesAttribute());
  header.insert("a double", Imf::DoubleAttribute(0.5));
  header.insert("a envmap", Imf::EnvmapAttribute());
  header.insert("a float", Imf::FloatAttribute(0.5F));
  header.insert("a floatvector", Imf::FloatVectorAttribute({1.0F, 2.0F}));
  header.insert("a int", Imf::IntAttribute(7));
  header.insert("a keycode", Imf::KeyCodeAttribute());
  header.insert("a m33d", Imf::M33dAttribute());
  header.insert("a m33f", Imf::M33fAttribute());
  header.insert("a m44d", Imf::M44dAttribute());
  header.insert("a m44f", Imf::M44fAttribute());
  header.insert("a preview", Imf::PreviewImageAttribute(Imf::PreviewImage(3, 2)));
  header.insert("a rational", Imf::RationalAttribute());
  header.insert("a stringvector", Imf::StringVectorAttribute({"one", "", "three"}));
  header.insert("a timecode", Imf::TimeCodeAttribute());
  header.insert("a v2d", Imf::V2dAttribute());
  header.insert("a v2f", Imf::V2fAttribute());
  header.insert("a v2i", Imf::V2iAttribute());
  header.insert("a v3d", Imf::V3dAttribute());
  header.insert("a v3f", Imf::V3fAttribute());
  header.insert("a v3i", Imf::V3iAttribute());
  return header;
}

// The names and types in a header, and where their sizes are.
struct Place {
  std::string name;
  std::string type;
  std::size_t at;
};
std::vector<Place> places_in(const std::string& bytes, std::size_t at = 8) {
  std::vector<Place> places;
  while (bytes[at] != '\0') {
    const std::string name = bytes.c_str() + at;
    at += name.size() + 1;
    const std::string type = bytes.c_str() + at;
    at += type.size() + 1;
    places.push_back({name, type, at});
    int32_t size = 0;
    std::memcpy(&size, bytes.data() + at, sizeof(size));
    at += sizeof(size) + static_cast<std::size_t>(size);
  }
  return places;
}

// The file with a byte more or less in one value, and its size so.
std::string resized(std::string bytes, const Place& place, int by) {
  int32_t size = 0;
  std::memcpy(&size, bytes.data() + place.at, sizeof(size));
  const std::size_t end = place.at + sizeof(size) + static_cast<std::size_t>(size);
  if (by > 0) {
    bytes.insert(end, 1, '\1');
  } else {
    bytes.erase(end - 1, 1);
  }
  size += by;
  std::memcpy(bytes.data() + place.at, &size, sizeof(size));
  return bytes;
}

void expect_refused(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
  try {
    open_exr(path);
    ADD_FAILURE() << "was read";
  } catch (const std::exception& error) {
    EXPECT_STREQ(error.what(), "its header is damaged or cut off");
  }
}

TEST(OpenExr, ReadsAttributesOfAllTypesAndOfTheirSizesOnly) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.exr";
  { const Imf::OutputFile file(path.c_str(), header_of_every_type()); }
  EXPECT_NO_THROW(open_exr(path));
  const std::string bytes = test::content_of(path);
  const std::vector<Place> places = places_in(bytes);
  EXPECT_GT(places.size(), 30U);
  for (const Place& place : places) {
    SCOPED_TRACE(place.name + " " + place.type);
    expect_refused(path, resized(bytes, place, 1));
    expect_refused(path, resized(bytes, place, -1));
  }
}

// A text has no size of its own, and what is of a type that nobody knows may have any.
TEST(OpenExr, ReadsTextsOfAnySize) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.exr";
  Imf::Header header(1, 1);
  header.channels().insert("R", Imf::Channel(Imf::HALF));
  for (const char* text : {"", "a", "some words"}) {
    header.insert("text", Imf::StringAttribute(text));
    { const Imf::OutputFile file(path.c_str(), header); }
    EXPECT_NO_THROW(open_exr(path)) << text;
    std::string bytes = test::content_of(path);
    bytes.replace(bytes.find("string"), 6, "strong");
    std::ofstream(path, std::ios::binary) << bytes;
    EXPECT_NO_THROW(open_exr(path)) << text;
  }
}

TEST(OpenExr, LooksAtTheHeadersOfAllParts) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "a.exr";
  std::vector<Imf::Header> headers(2, header_of_every_type());
  for (std::size_t i = 0; i < headers.size(); ++i) {
    headers[i].setName("part " + std::to_string(i));
    headers[i].setType("scanlineimage");
  }
  { const Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 2); }
  EXPECT_NO_THROW(open_exr(path));
  const std::string bytes = test::content_of(path);
  const std::size_t second = bytes.find("a box2f", bytes.find("a box2f") + 1);
  expect_refused(path, resized(bytes, places_in(bytes, second).front(), 1));
}

}  // namespace
}  // namespace trisect
