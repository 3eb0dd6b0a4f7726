// Models of every format, by content and by name.
#include "app/mesh/model_file.h"

#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/mesh/assimp_file.h"
#include "app/mesh/mesh_builder.h"
#include "app/tessellation/flat_mesh_file.h"
#include "tests/support/file_content.h"
#include "tests/support/peak_memory.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

using glm::dvec3;

// A pyramid of a square and four triangles, as PLY.
const std::string kPyramid =
    "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "element face 5\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.5 1\n"
    "4 3 2 1 0\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";

// The same in another format that Assimp writes.
std::string pyramid_as(const char* format) {
  const test::TemporaryFolder folder;
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(kPyramid.data(), kPyramid.size(), 0, "ply");
  Assimp::Exporter exporter;
  const std::string file = folder / "pyramid";
  if (exporter.Export(scene, format, file) != aiReturn_SUCCESS) return exporter.GetErrorString();
  return test::content_of(file);
}

void expect_pyramid(const PolygonModel& model, const std::string& what) {
  const BuiltMesh built = build_mesh(model, what);
  EXPECT_EQ(built.report.triangles, 6U) << what;
  EXPECT_EQ(built.report.vertices, 5U) << what;
  EXPECT_EQ(built.report.open_edges, 0U) << what;
  EXPECT_EQ(built.report.flipped_edges, 0U) << what;
}

TEST(ModelFile, ReadsEveryFormatWhateverItsName) {
  const test::TemporaryFolder folder;
  // Assimp 5.2 cannot read the binary FBX that it writes.
  for (const char* format : {"ply", "plyb", "stl", "stlb", "fbxa", "obj", "glb2"}) {
    const std::string bytes = pyramid_as(format);
    for (const char* name : {"model", "model.obj", "model.stl"}) {
      // What is no STL by its content is not read as one; OBJ has no mark of its own.
      if (std::string(format) == "obj" && std::string(name) == "model.stl") continue;
      const std::string path = folder / name;
      std::ofstream(path, std::ios::binary) << bytes;
      SCOPED_TRACE(std::string(format) + " as " + name);
      expect_pyramid(read_model(path), format);
    }
  }
}

TEST(ModelFile, TakesTheNameWhereTheContentSaysNothing) {
  EXPECT_EQ(format_of("v 0 0 0\n", "a.obj"), ModelFormat::obj);
  EXPECT_EQ(format_of("v 0 0 0\n", "a"), ModelFormat::obj);
  EXPECT_EQ(format_of("", "a.PLY"), ModelFormat::ply);
  EXPECT_EQ(format_of("", "a.glb.gz"), ModelFormat::gltf);
  EXPECT_EQ(format_of("solid", "a.stl"), ModelFormat::stl);
  EXPECT_EQ(format_of("solid of obj\n", "a.obj"), ModelFormat::obj);
  EXPECT_EQ(format_of(" {\"asset\"", "a.txt"), ModelFormat::gltf);
  EXPECT_EQ(format_of("", "a.fbx"), ModelFormat::fbx);
}

TEST(ModelFile, KeepsThePolygonsOfPly) {
  const PolygonModel model = parse_by_assimp(kPyramid, "ply", "model.ply");
  EXPECT_EQ(model.sizes, (std::vector<uint32_t>{4, 3, 3, 3, 3}));
  EXPECT_EQ(model.corners[0].normal, PolygonCorner::no_normal);
  std::string with_normals = kPyramid;
  with_normals.replace(with_normals.find("element face"), 0,
                       "property float nx\nproperty float ny\nproperty float nz\n");
  for (const char* line : {"0 0 0\n", "1 0 0\n", "1 1 0\n", "0 1 0\n", "0.5 0.5 1\n"}) {
    const std::string text(line);
    with_normals.replace(with_normals.find("\n" + text) + 1, text.size(),
                         text.substr(0, text.size() - 1) + " 0 0 2\n");
  }
  const PolygonModel smooth = parse_by_assimp(with_normals, "ply", "model.ply");
  EXPECT_EQ(smooth.normals.at(smooth.corners[0].normal), dvec3(0, 0, 2));
}

// A face has the mean of its corners' colours.
TEST(ModelFile, TakesTheColoursOfPly) {
  const test::TemporaryFolder folder;
  const auto ply = [](const std::string& colors, const std::string& suffix) {
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
           "property float z\n" +
           colors + "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0" +
           (suffix.empty() ? "\n1 0 0\n1 1 0\n0 1 0\n"
                           : " 255 0 0\n1 0 0 255 0 0\n1 1 0 255 255 0\n0 1 0 0 0 255\n") +
           "3 0 1 2\n3 0 2 3\n";
  };
  const std::string colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  std::ofstream(folder / "a.ply") << ply(colors, "colors");
  const BuiltMesh built = build_mesh(read_model(folder / "a.ply"), "a.ply");
  ASSERT_EQ(built.mesh.colors.size(), 2U);
  EXPECT_EQ(built.report.colored, 2U);
  EXPECT_LT(glm::distance(built.mesh.colors[0], glm::vec3(1.0F, 1.0F / 3.0F, 0.0F)), 1e-6F);
  EXPECT_LT(glm::distance(built.mesh.colors[1], glm::vec3(2.0F, 1.0F, 1.0F) / 3.0F), 1e-6F);
  std::ofstream(folder / "a.ply") << ply("", "");
  EXPECT_TRUE(build_mesh(read_model(folder / "a.ply"), "a.ply").mesh.colors.empty());
}

// What some programs take for colours there others write anything into.
TEST(ModelFile, TakesNoColoursFromStl) {
  std::string stl = pyramid_as("stlb");
  for (std::size_t end = 84 + 50; end <= stl.size(); end += 50) {
    stl[end - 2] = '\x1f';
    stl[end - 1] = '\x80';
  }
  EXPECT_TRUE(build_mesh(parse_by_assimp(stl, "stl", "a.stl"), "a.stl").mesh.colors.empty());
}

TEST(ModelFile, MakesNormalsForStl) {
  const BuiltMesh built = build_mesh(parse_by_assimp(pyramid_as("stlb"), "stl", "a.stl"), "a.stl");
  EXPECT_EQ(built.report.normals, NormalSource::welded);
  EXPECT_EQ(built.report.hard_edges, 0U);
}

TEST(ModelFile, SaysWhyAFileCannotBeRead) {
  const auto complaint = [](const std::string& bytes, const char* format) -> std::string {
    try {
      parse_by_assimp(bytes, format, "a");
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  for (const char* format : {"ply", "stl", "fbx"}) {
    const std::string message = complaint("nothing of the kind", format);
    EXPECT_TRUE(message.starts_with("a: cannot be read as ")) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_FALSE(message.ends_with("..")) << message;
  }
}

// AddressSanitizer keeps what is freed.
#ifndef __SANITIZE_ADDRESS__

// The file itself, what the library makes of it, ours, and the mesh: none of them longer than it is
// needed.
TEST(ModelFile, ReadsInSixTimesItsSize) {
  const test::TemporaryFolder folder;
  const auto path = [&](MeshFormat format) {
    return folder / (format == MeshFormat::ply   ? "a.ply"
                     : format == MeshFormat::stl ? "a.stl"
                                                 : "a.glb");
  };
  const std::vector<MeshFormat> formats{MeshFormat::ply, MeshFormat::stl, MeshFormat::glb};
  {
    const Mesh mesh = test::load_asset("sphere-20");
    const FlatMesh flat = *divided_evenly(mesh, bake(mesh, {}), 150);
    for (const MeshFormat format : formats) {
      AtomicFile file(path(format));
      write_mesh(flat, format, file);
      file.commit();
    }
  }
  for (const MeshFormat format : formats) {
    const test::PeakMemory peak;
    const BuiltMesh built = build_mesh(read_model(path(format)), "a");
    const double taken = peak.bytes();
    const auto file = static_cast<double>(std::filesystem::file_size(path(format)));
    EXPECT_EQ(built.mesh.triangles.size(), 450000U);
    EXPECT_LT(taken / file, 6.0) << path(format);
    EXPECT_GT(taken / file, 2.0) << "the peak was not measured";
    std::printf("%s: %.1f times its %.1f MB\n", path(format).filename().c_str(), taken / file,
                file / 1e6);
  }
}

#endif

}  // namespace
}  // namespace trisect
