#include "app/mesh/obj_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "app/base/error.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

ObjFile parse(const std::string& text) {
  return parse_obj(text, "model.obj");
}

// The message of the error that a text gives.
std::string complaint(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ObjFile, ReadsPositionsNormalsAndPolygons) {
  const ObjFile file = parse(std::string(kSquare) + "vn 0 0 2\nf 1//1 2//1 3//1 4//1\n");
  ASSERT_EQ(file.positions.size(), 4U);
  EXPECT_EQ(file.positions[2], glm::dvec3(1, 1, 0));
  ASSERT_EQ(file.normals.size(), 1U);
  EXPECT_EQ(file.normals[0], glm::dvec3(0, 0, 2));
  EXPECT_EQ(file.sizes, std::vector<uint32_t>{4});
  EXPECT_EQ(file.corners[3].position, 3U);
  EXPECT_EQ(file.corners[3].normal, 0U);
}

TEST(ObjFile, ReadsEveryFormOfCorner) {
  const std::string data = std::string(kSquare) + "vt 0 0\nvn 0 0 1\n";
  for (const char* face : {"f 1 2 3", "f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/1/1 3/1/1"}) {
    const ObjFile file = parse(data + face);
    ASSERT_EQ(file.corners.size(), 3U) << face;
    EXPECT_EQ(file.corners[2].position, 2U) << face;
    const bool has_normal = std::string(face).find("1/1/1") != std::string::npos ||
                            std::string(face).find("//") != std::string::npos;
    EXPECT_EQ(file.corners[0].normal, has_normal ? 0U : ObjCorner::no_normal) << face;
  }
}

TEST(ObjFile, NegativeIndicesCountFromTheLastOneSoFar) {
  const ObjFile file =
      parse(std::string(kSquare) + "vn 1 0 0\nvn 0 0 1\nf -4//-1 -3//-1 -2//-2\nv 9 9 9\n");
  EXPECT_EQ(file.corners[0].position, 0U);
  EXPECT_EQ(file.corners[2].position, 2U);
  EXPECT_EQ(file.corners[0].normal, 1U);
  EXPECT_EQ(file.corners[2].normal, 0U);
}

TEST(ObjFile, GathersAllGroupsAndObjects) {
  const ObjFile file =
      parse(std::string(kSquare) +
            "g one\nf 1 2 3\ng two three\nusemtl red\ns 1\nf 1 3 4\no last\nf 2 3 4\n");
  EXPECT_EQ(file.sizes.size(), 3U);
}

TEST(ObjFile, KeepsPolygonsOfManyCorners) {
  std::string text;
  std::string face = "f";
  for (int i = 1; i <= 300; ++i) {
    text += "v " + std::to_string(i) + " " + std::to_string(i * i) + " 0\n";
    face += " " + std::to_string(i);
  }
  EXPECT_EQ(parse(text + face).sizes, std::vector<uint32_t>{300});
}

TEST(ObjFile, TakesLineEndsMarksAndTheEndOfTheFileAsTheyCome) {
  const std::string unix_text = std::string(kSquare) + "f 1 2 3\nf 1 3 4";
  std::string dos_text;
  for (const char c : unix_text) {
    if (c == '\n') dos_text.push_back('\r');
    dos_text.push_back(c);
  }
  for (const std::string& text : {unix_text, dos_text, std::string("\xEF\xBB\xBF") + unix_text}) {
    const ObjFile file = parse(text);
    EXPECT_EQ(file.positions.size(), 4U);
    EXPECT_EQ(file.sizes.size(), 2U);
  }
}

TEST(ObjFile, PassesOverComments) {
  const ObjFile file = parse("# v 9\nv 0 0 0 # origin\nv 1 0 0\nv 0 1 0#\nf 1 2 3 # f 1 2\n");
  EXPECT_EQ(file.positions.size(), 3U);
  EXPECT_EQ(file.sizes, std::vector<uint32_t>{3});
}

TEST(ObjFile, KeepsDoublePrecision) {
  const ObjFile file = parse("v 1000000.0000001 -1e-3 +2.5E2\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  // The parser sums decimal digits in double precision: right to some ten units in the last place.
  EXPECT_NEAR(file.positions[0].x, 1000000.0000001, 1e-8);
  EXPECT_NEAR(file.positions[0].y, -1e-3, 1e-17);
  EXPECT_NEAR(file.positions[0].z, 250.0, 1e-12);
}

TEST(ObjFile, NamesTheFileAndTheLineOfWhatIsWrong) {
  const std::string square(kSquare);
  EXPECT_EQ(complaint("v 0 0 0\nv 1 x 0\n"), "model.obj, line 2: 'x' is not a finite number.");
  EXPECT_EQ(complaint("v 0 0 0\r\nv 1 nan 0\r\n"),
            "model.obj, line 2: 'nan' is not a finite number.");
  EXPECT_EQ(complaint("v 0 0 0\nvn inf 0 1\n"), "model.obj, line 2: 'inf' is not a finite number.");
  EXPECT_EQ(complaint("v 1e999 0 0\n"), "model.obj, line 1: '1e999' is not a finite number.");
  EXPECT_EQ(complaint("v 1 2\n"), "model.obj, line 1: 'v' has fewer than three coordinates.");
  EXPECT_EQ(complaint(square + "f 1 2\n"),
            "model.obj, line 5: a face has 2 corners, fewer than three.");
  EXPECT_EQ(complaint(square + "f 1 2 x\n"), "model.obj, line 5: 'x' is not a corner of a face.");
  EXPECT_EQ(complaint(square + "f 1 2 1.5\n"),
            "model.obj, line 5: '1.5' is not a corner of a face.");
  EXPECT_EQ(complaint(square + "f 1 2 5\n"),
            "model.obj, line 5: the face names vertex 5, but there are 4 so far.");
  EXPECT_EQ(complaint(square + "\n# note\nf 1 2 -5\n"),
            "model.obj, line 7: the face names vertex -5, but there are 4 so far.");
  EXPECT_EQ(complaint(square + "f 0 1 2\n"), "model.obj, line 5: '0' is not a corner of a face.");
  EXPECT_EQ(complaint(square + "vn 0 0 1\nf 1//1 2//1 3//2\n"),
            "model.obj, line 6: the face names normal 2, but there are 1 so far.");
  for (const char* corner :
       {"4294967297", "99999999999", "1-2", "1//0", "1/", "1//", "1/2/3/4", "-", "/1"}) {
    EXPECT_EQ(complaint(square + "vn 0 0 1\nf 1 2 " + corner + "\n"),
              "model.obj, line 6: '" + std::string(corner) + "' is not a corner of a face.");
  }
  EXPECT_EQ(complaint(square + "f 1 2 \\\n3\n"),
            "model.obj, line 5: a line that is continued by a backslash is not supported.");
  EXPECT_EQ(complaint(square), "model.obj: the file has no faces.");
  EXPECT_EQ(complaint(""), "model.obj: the file has no faces.");
}

TEST(ObjFile, SaysWhyAFileCannotBeRead) {
  const test::TemporaryFolder folder;
  const auto complain = [](const std::filesystem::path& path) -> std::string {
    try {
      read_obj(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  const std::filesystem::path absent = folder / "absent.obj";
  EXPECT_EQ(complain(absent), absent.string() + ": cannot be opened: No such file or directory.");
  EXPECT_EQ(complain(folder.path()), folder.path().string() + ": is a directory, not an OBJ file.");
  const std::filesystem::path noise = folder / "noise.obj";
  std::ofstream(noise, std::ios::binary) << std::string("\x00\xff\x01garbage\nf\nv", 14);
  EXPECT_EQ(complain(noise).find(noise.string()), 0U) << complain(noise);
}

}  // namespace
}  // namespace trisect
