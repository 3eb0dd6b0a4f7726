#include "app/mesh/obj_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <fstream>

#include "app/base/error.h"
#include "tests/support/file_content.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

PolygonModel parse(const std::string& text) {
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
  const PolygonModel file = parse(std::string(kSquare) + "vn 0 0 2\nf 1//1 2//1 3//1 4//1\n");
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
    const PolygonModel file = parse(data + face);
    ASSERT_EQ(file.corners.size(), 3U) << face;
    EXPECT_EQ(file.corners[2].position, 2U) << face;
    const bool has_normal = std::string(face).find("1/1/1") != std::string::npos ||
                            std::string(face).find("//") != std::string::npos;
    EXPECT_EQ(file.corners[0].normal, has_normal ? 0U : PolygonCorner::no_normal) << face;
  }
}

TEST(ObjFile, NegativeIndicesCountFromTheLastOneSoFar) {
  const PolygonModel file =
      parse(std::string(kSquare) + "vn 1 0 0\nvn 0 0 1\nf -4//-1 -3//-1 -2//-2\nv 9 9 9\n");
  EXPECT_EQ(file.corners[0].position, 0U);
  EXPECT_EQ(file.corners[2].position, 2U);
  EXPECT_EQ(file.corners[0].normal, 1U);
  EXPECT_EQ(file.corners[2].normal, 0U);
}

TEST(ObjFile, GathersAllGroupsAndObjects) {
  const PolygonModel file =
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
    const PolygonModel file = parse(text);
    EXPECT_EQ(file.positions.size(), 4U);
    EXPECT_EQ(file.sizes.size(), 2U);
  }
}

TEST(ObjFile, PassesOverComments) {
  const PolygonModel file = parse("# v 9\nv 0 0 0 # origin\nv 1 0 0\nv 0 1 0#\nf 1 2 3 # f 1 2\n");
  EXPECT_EQ(file.positions.size(), 3U);
  EXPECT_EQ(file.sizes, std::vector<uint32_t>{3});
}

TEST(ObjFile, KeepsDoublePrecision) {
  const PolygonModel file = parse("v 1000000.0000001 -1e-3 +2.5E2\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  // The parser sums decimal digits in double precision: right to some ten units in the last place.
  EXPECT_NEAR(file.positions[0].x, 1000000.0000001, 1e-8);
  EXPECT_NEAR(file.positions[0].y, -1e-3, 1e-17);
  EXPECT_NEAR(file.positions[0].z, 250.0, 1e-12);
}

// The notes of a text, in one line.
std::string notes_of(const std::string& text) {
  std::string all;
  for (const std::string& note : parse(text).notes) all += (all.empty() ? "" : ", ") + note;
  return all;
}

TEST(ObjFile, TakesCornersOfWhichPartsAreLeftOut) {
  for (const char* face :
       {"f 1/ 2/ 3/", "f 1// 2// 3//", "f +1 +2 +3", "f 1/1/0 2//0 3/0/", "f 1/9/ 2/9 3"}) {
    const PolygonModel file = parse(std::string(kSquare) + "vn 0 0 1\n" + face);
    ASSERT_EQ(file.corners.size(), 3U) << face;
    for (uint32_t i = 0; i < 3; ++i) {
      EXPECT_EQ(file.corners[i].position, i) << face;
      EXPECT_EQ(file.corners[i].normal, PolygonCorner::no_normal) << face;
    }
  }
}

TEST(ObjFile, TakesFacesBeforeTheirVertices) {
  const PolygonModel file =
      parse("f 1//2 2//1 3//1\nv 0 0 0\nf -1 2 3\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 1 0 0\n");
  ASSERT_EQ(file.corners.size(), 6U);
  EXPECT_EQ(file.corners[0].normal, 1U);
  EXPECT_EQ(file.corners[2].position, 2U);
  EXPECT_EQ(file.corners[3].position, 0U);
}

TEST(ObjFile, JoinsContinuedLines) {
  const PolygonModel file = parse(
      "v 0 0 \\\n0\nv 1 0 0\r\nv 1 \\ \r\n 1 0\nv 0 1 0\nf 1 2 \\\n3 \\\n4 \\\n\n"
      "usemtl odd\\\nf 1 2 3");
  EXPECT_EQ(file.positions.size(), 4U);
  EXPECT_EQ(file.positions[2], glm::dvec3(1, 1, 0));
  EXPECT_EQ(file.sizes, (std::vector<uint32_t>{4, 3}));
}

TEST(ObjFile, TakesNumbersThatAreTooSmallForZero) {
  const PolygonModel file = parse("v 0 0 1e-400\nv 1 0 -5.53848e-321\nv 1 1 1e-310\nf 1 2 3\n");
  EXPECT_EQ(file.positions[0].z, 0.0);
  EXPECT_NEAR(file.positions[1].z, 0.0, 1e-320);
}

TEST(ObjFile, SaysWhatItLeavesOut) {
  const std::string square = std::string(kSquare) + "f 1 2 3 4\n";
  EXPECT_EQ(notes_of(square + "g a\nvt 0 0\n"), "");
  EXPECT_EQ(
      notes_of(square + "p 1 2\nl 1 2 3\nl 3 4\nf 1\nf 1 2\n"),
      "1 point element left out, 2 line elements left out, 2 faces of one or two corners left "
      "out");
  EXPECT_EQ(notes_of(square + "cstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 1\nend\nsurf 0 1 0 "
                              "1 1 2 3 4\nend\n"),
            "1 curve left out, 1 free-form surface left out");
  EXPECT_EQ(notes_of("v 0 0 0 1\nv 2 0 0 2\nv 2 2 0 0.5 0.5 0.5\nf 1 2 3\n"),
            "1 vertex with a weight, which does not count");
  EXPECT_EQ(notes_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1//1 2//2 3\n"),
            "2 corners name a normal in a file that has none");
}

TEST(ObjFile, ReadsSmoothingGroups) {
  const std::string square(kSquare);
  EXPECT_TRUE(parse(square + "f 1 2 3\n").smoothing_groups.empty());
  EXPECT_EQ(parse(square + "f 1 2 3\ns off\nf 1 2 3\ns 7\nf 1 2 3\nf 1 2\nf 1 3 4\ns 0\nf 1 2 4\n")
                .smoothing_groups,
            (std::vector<uint32_t>{1, 0, 7, 7, 0}));
}

TEST(ObjFile, KeepsTheNamesOfObjectsOrElseGroups) {
  const std::string square(kSquare);
  const auto names_of = [](const PolygonModel& model) {
    std::string names;
    for (const PolygonGroup& group : model.groups) {
      names += std::to_string(group.first) + group.name + ";";
    }
    return names;
  };
  EXPECT_EQ(names_of(parse(square + "f 1 2 3\n")), "");
  EXPECT_EQ(names_of(parse(square + "g a\ng left side \nf 1 2 3\nf 1 2 3\ng\nf 1 2 3\ng c\n")),
            "0left side;2;");
  EXPECT_EQ(names_of(parse(square + "g a\nf 1 2 3\no b\nf 1 2 3\n")), "0;1b;");
}

TEST(ObjFile, ReadsUtf16) {
  const std::string text = "# \xE4\n" + std::string(kSquare) + "f 1 2 3 4";
  for (const bool high_first : {false, true}) {
    std::string wide = high_first ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : text) {
      if (high_first) wide.push_back('\0');
      wide.push_back(c);
      if (!high_first) wide.push_back('\0');
    }
    EXPECT_EQ(parse(wide).sizes, std::vector<uint32_t>{4});
  }
}

TEST(ObjFile, ReadsWhatGzipHasCompressed) {
  const test::TemporaryFolder folder;
  const std::string text = std::string(kSquare) + "f 1 2 3 4\n";
  const std::string name = folder / "square.obj.gz";
  gzFile file = gzopen(name.c_str(), "wb");
  ASSERT_NE(file, nullptr);
  ASSERT_EQ(gzwrite(file, text.data(), static_cast<unsigned>(text.size())),
            static_cast<int>(text.size()));
  ASSERT_EQ(gzclose(file), Z_OK);
  EXPECT_EQ(read_obj(name).sizes, std::vector<uint32_t>{4});
  // Two streams, one after the other, are one file; a part of one is none.
  const std::string bytes = test::content_of(name);
  std::ofstream(folder / "twice.gz", std::ios::binary) << bytes << bytes;
  EXPECT_EQ(read_obj(folder / "twice.gz").sizes, (std::vector<uint32_t>{4, 4}));
  for (const std::size_t size : {std::size_t{2}, bytes.size() / 2, bytes.size() - 1}) {
    const std::string cut = folder / "cut.gz";
    std::ofstream(cut, std::ios::binary) << bytes.substr(0, size);
    EXPECT_THROW(read_obj(cut), InputError) << size;
  }
}

TEST(ObjFile, NamesTheFileAndTheLineOfWhatIsWrong) {
  const std::string square(kSquare);
  EXPECT_EQ(complaint("v 0 0 0\nv 1 x 0\n"), "model.obj, line 2: 'x' is not a finite number.");
  EXPECT_EQ(complaint("v 0 0 0\r\nv 1 nan 0\r\n"),
            "model.obj, line 2: 'nan' is not a finite number.");
  EXPECT_EQ(complaint("v 0 0 0\nvn inf 0 1\n"), "model.obj, line 2: 'inf' is not a finite number.");
  EXPECT_EQ(complaint("v 1e999 0 0\n"), "model.obj, line 1: '1e999' is not a finite number.");
  EXPECT_EQ(complaint("v 1 2\n"), "model.obj, line 1: 'v' has fewer than three coordinates.");
  EXPECT_EQ(complaint(square + "f 1 2 x\n"), "model.obj, line 5: 'x' is not a corner of a face.");
  EXPECT_EQ(complaint(square + "f 1 2 1.5\n"),
            "model.obj, line 5: '1.5' is not a corner of a face.");
  EXPECT_EQ(complaint(square + "f 1 2 5\n"),
            "model.obj, line 5: the face names vertex 5, but there are 4.");
  EXPECT_EQ(complaint(square + "\n# note\nf 1 2 -5\n"),
            "model.obj, line 7: the face names vertex -5, but there are 4 so far.");
  EXPECT_EQ(complaint(square + "f 0 1 2\n"), "model.obj, line 5: '0' is not a corner of a face.");
  EXPECT_EQ(complaint(square + "vn 0 0 1\nf 1//1 2//1 3//2\n"),
            "model.obj, line 6: the face names normal 2, but there are 1.");
  for (const char* corner : {"4294967297", "99999999999", "1-2", "+-1", "1/2/3/4", "-", "/1"}) {
    EXPECT_EQ(complaint(square + "vn 0 0 1\nf 1 2 " + corner + "\n"),
              "model.obj, line 6: '" + std::string(corner) + "' is not a corner of a face.");
  }
  // The last line, without its end; a line that goes on over others; what comes after such a one.
  EXPECT_EQ(complaint(square + "f 1 2 5"),
            "model.obj, line 5: the face names vertex 5, but there are 4.");
  EXPECT_EQ(complaint(square + "f 1 2 \\\n\\\n5\n"),
            "model.obj, line 5: the face names vertex 5, but there are 4.");
  EXPECT_EQ(complaint(square + "f 1 2 \\\n3\nv x 0 0\n"),
            "model.obj, line 7: 'x' is not a finite number.");
  EXPECT_EQ(complaint("v +-1 0 0\n"), "model.obj, line 1: '+-1' is not a finite number.");
  EXPECT_EQ(complaint("s smooth\n"), "model.obj, line 1: 'smooth' is not a smoothing group.");
  EXPECT_EQ(complaint(square), "model.obj: the file has no faces.");
  EXPECT_EQ(complaint(square + "l 1 2 3\nl 1 4\nf 1 2\n"),
            "model.obj: the file has no faces; 2 line elements left out, 1 face of one or two "
            "corners left out.");
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
  EXPECT_EQ(complain(folder.path()),
            folder.path().string() + ": cannot be read: it is a directory.");
  const std::filesystem::path noise = folder / "noise.obj";
  std::ofstream(noise, std::ios::binary) << std::string("\x00\xff\x01garbage\nf\nv", 14);
  EXPECT_EQ(complain(noise).find(noise.string()), 0U) << complain(noise);
}

// Those of "mtllib" files in the model's folder and below; of others nothing is read.
TEST(ObjFile, TakesTheColoursOfMaterials) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "in/sub");
  std::ofstream(folder / "in/sub/a b.mtl")
      << "# two\nnewmtl red one \r\nKa 1 1 1\nKd 0.5 0.25 0\r\n\tKs 1 1 1\nnewmtl bright\nKd 2 "
         "-1 1\nnewmtl textured\nKd 1 1 1\nmap_Kd t.png\nnewmtl black\nKd 0 0 0\nnewmtl bare\n";
  std::ofstream(folder / "outside.mtl") << "newmtl outside\nKd 1 1 1\n";
  std::ofstream(folder / "in/model.obj")
      << "mtllib sub/a b.mtl\nmtllib ../outside.mtl\nmtllib none.mtl\n"
      << kSquare
      << "f 1 2 3\nusemtl red one\nf 1 2 3\nf 1 3 4\nusemtl bright\nf 1 2 3\nusemtl "
         "textured\nf 1 2 3\nusemtl outside\nf 1 2 3\nusemtl black\nf 1 2 3\nusemtl bare\nf 1 2 "
         "3\n";
  const PolygonModel model = read_obj(folder / "in/model.obj");
  const glm::vec3 none = PolygonModel::no_color;
  const glm::vec3 red(0.5F, 0.25F, 0.0F);
  EXPECT_EQ(model.colors, (std::vector<glm::vec3>{none, red, red, glm::vec3(1, 0, 1), none, none,
                                                  glm::vec3(0), none}));
  EXPECT_EQ(model.notes,
            (std::vector<std::string>{"1 material file outside the model's folder not read",
                                      "1 material file not found, or not readable"}));
  // A file that uses none costs nothing.
  EXPECT_TRUE(parse(std::string("mtllib none.mtl\n") + kSquare + "f 1 2 3\n").colors.empty());
}

// Material files are read as OBJ files are.
TEST(ObjFile, ReadsMaterialsAsTheyAreWritten) {
  const test::TemporaryFolder folder;
  const auto color_of = [&](const std::string& materials, const std::string& material) {
    std::ofstream(folder / "a.mtl", std::ios::binary) << materials;
    std::ofstream(folder / "b.mtl") << "newmtl other\nKd 0 0 1\n";
    std::ofstream(folder / "m.obj") << "mtllib a.mtl b.mtl\n"
                                    << kSquare << "f 1 2 3\nusemtl " << material << "\nf 1 3 4\n";
    const PolygonModel model = read_obj(folder / "m.obj");
    EXPECT_TRUE(model.notes.empty());
    if (model.colors.empty()) return PolygonModel::no_color;
    EXPECT_EQ(model.colors[0], PolygonModel::no_color);
    return model.colors[1];
  };
  const glm::vec3 red(1, 0, 0);
  EXPECT_EQ(color_of("newmtl a\nKd 1 0 0\n", "a"), red);
  EXPECT_EQ(color_of("newmtl a\nKd 1 0 0\n", "other"), glm::vec3(0, 0, 1));
  EXPECT_EQ(color_of("\xEF\xBB\xBFnewmtl a\rKd 1 0 0 # red\r", "a"), red);
  EXPECT_EQ(
      color_of("newmtl Material #25\nKd 1 0 0\nnewmtl Material #26\nKd 0 1 0", "Material #25"),
      red);
  EXPECT_EQ(color_of("newmtl a\nKd 0.5\n", "a"), glm::vec3(0.5F));
  EXPECT_EQ(color_of("Kd 0 1 0\nnewmtl a\nKd 1 0 0\nnewmtl\nKd 0 1 0\n", "a"), red);
  EXPECT_EQ(color_of("newmtl a\nKd spectral file.rfl\n", "a"), PolygonModel::no_color);
  std::string wide("\xFF\xFE");
  for (const char c : std::string("newmtl a\nKd 1 0 0\n")) wide.append({c, '\0'});
  EXPECT_EQ(color_of(wide, "a"), red);
}

// What leads out of the folder is not read, nor what is no file.
TEST(ObjFile, ReadsNoMaterialsFromElsewhere) {
  const test::TemporaryFolder folder;
  const test::TemporaryFolder other;
  std::ofstream(other / "x.mtl") << "newmtl a\nKd 1 1 1\n";
  std::filesystem::create_symlink(other.path(), folder.path() / "link");
  std::filesystem::create_symlink("/dev/zero", folder.path() / "zero.mtl");
  ASSERT_EQ(mkfifo((folder / "pipe.mtl").c_str(), 0600), 0);
  for (const std::string& library :
       std::vector<std::string>{"link/x.mtl", "zero.mtl", "pipe.mtl", (other / "x.mtl"), ".",
                                std::string(5000, 'x'), ""}) {
    std::ofstream(folder / "m.obj") << "mtllib " << library << "\n"
                                    << kSquare << "usemtl a\nf 1 2 3\n";
    const PolygonModel model = read_obj(folder / "m.obj");
    EXPECT_TRUE(model.colors.empty()) << library;
    EXPECT_EQ(model.notes.size(), 1U) << library;
  }
}

}  // namespace
}  // namespace trisect
