#include "app/mesh/mesh_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "app/base/error.h"
#include "app/mesh/obj_file.h"

namespace trisect {
namespace {

using glm::dvec3;

BuiltMesh build(const std::string& text, const MeshOptions& options = {}) {
  return build_mesh(parse_obj(text, "model.obj"), "model.obj", options);
}

// A cube of quadrilaterals without normals, seen from outside.
constexpr const char* kCube =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

// Rounding of a few double-precision operations on numbers of order 1.
constexpr double kSomeRoundings = 1e-14;

TEST(BuildMesh, ReportsAClosedCube) {
  const BuiltMesh built = build(kCube);
  EXPECT_EQ(built.report.triangles, 12U);
  EXPECT_EQ(built.report.vertices, 8U);
  EXPECT_EQ(built.report.normals, NormalSource::welded);
  EXPECT_EQ(built.report.degenerate_dropped, 0U);
  EXPECT_EQ(built.report.hard_edges, 0U);
  EXPECT_EQ(built.report.open_edges, 0U);
  EXPECT_EQ(built.report.non_manifold_edges, 0U);
  EXPECT_EQ(built.report.flipped_edges, 0U);
}

TEST(BuildMesh, TakesArrays) {
  const BuiltMesh file = build("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\nf 2 4 3\n");
  const std::vector<dvec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};
  const std::vector<uint32_t> triangles{0, 1, 2, 1, 3, 2};
  const BuiltMesh arrays = build_mesh(positions, {}, triangles);
  EXPECT_EQ(arrays.mesh.positions, file.mesh.positions);
  EXPECT_EQ(arrays.mesh.normals, file.mesh.normals);
  ASSERT_EQ(arrays.mesh.triangles.size(), 2U);
  EXPECT_EQ(arrays.mesh.triangles[1].vertex, file.mesh.triangles[1].vertex);
  const std::vector<dvec3> up(4, dvec3(0, 0, 2));
  const BuiltMesh with_normals = build_mesh(positions, up, triangles);
  EXPECT_EQ(with_normals.report.normals, NormalSource::file);
  EXPECT_EQ(with_normals.mesh.normals[with_normals.mesh.triangles[0].normal[2]], dvec3(0, 0, 1));
}

TEST(BuildMesh, RefusesArraysThatDoNotGoTogether) {
  const std::vector<dvec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<dvec3> infinite{{0, 0, 0}, {INFINITY, 0, 0}, {0, 1, 0}};
  const std::vector<uint32_t> triangle{0, 1, 2};
  const auto message_of = [](auto&&... arrays) -> std::string {
    try {
      build_mesh(arrays...);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  using Indices = std::vector<uint32_t>;
  using Vectors = std::vector<dvec3>;
  EXPECT_EQ(message_of(positions, Vectors{}, Indices{}), "mesh: it has no triangles.");
  EXPECT_EQ(message_of(positions, Vectors{}, Indices{0, 1}),
            "mesh: 2 indices are not three for each triangle.");
  EXPECT_EQ(message_of(positions, Vectors{}, Indices{0, 1, 3}),
            "mesh: index 3 names none of 3 positions.");
  EXPECT_EQ(message_of(positions, Vectors{{0, 0, 1}}, triangle),
            "mesh: 1 normals are not one for each of 3 positions.");
  EXPECT_EQ(message_of(infinite, Vectors{}, triangle), "mesh: a position is not finite.");
  EXPECT_EQ(message_of(positions, infinite, triangle), "mesh: a normal is not finite.");
  EXPECT_EQ(message_of(positions, Vectors{}, Indices{0, 0, 1}), "mesh: every face has zero area.");
}

TEST(BuildMesh, WeighsNormalsByAngle) {
  // At a cube's corner three faces meet at right angles, one or two triangles each: weighted by
  // angle, and only so, each face counts the same.
  const BuiltMesh built = build(kCube);
  for (const MeshTriangle& t : built.mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const dvec3 outward = glm::normalize(built.mesh.positions[t.vertex[i]] - dvec3(0.5));
      EXPECT_LT(glm::distance(built.mesh.normals[t.normal[i]], outward), kSomeRoundings);
    }
  }
}

TEST(BuildMesh, WeldsPositionsThatAreWrittenTwice) {
  // Two triangles that share an edge only by value, 0 and -0 among them.
  const BuiltMesh built =
      build("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 1 -0 0\nv 1 1 1\nv -0 1 0\nf 4 5 6\n");
  EXPECT_EQ(built.report.vertices, 4U);
  EXPECT_EQ(built.report.open_edges, 4U);
  EXPECT_EQ(built.report.hard_edges, 0U);
}

TEST(BuildMesh, KeepsTheFilesNormalsAtUnitLength) {
  const BuiltMesh built =
      build("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 5\nvn 3e-200 0 4e-200\nf 1//1 2//2 3//1\n");
  EXPECT_EQ(built.report.normals, NormalSource::file);
  const MeshTriangle& t = built.mesh.triangles[0];
  EXPECT_LT(glm::distance(built.mesh.normals[t.normal[0]], dvec3(0, 0, 1)), kSomeRoundings);
  EXPECT_LT(glm::distance(built.mesh.normals[t.normal[1]], dvec3(0.6, 0, 0.8)), kSomeRoundings);
}

TEST(BuildMesh, FillsInMissingAndZeroNormals) {
  const BuiltMesh built = build("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 1\nvn 0 0 0\nf 1//1 2 3//2\n");
  EXPECT_EQ(built.report.normals, NormalSource::mixed);
  const MeshTriangle& t = built.mesh.triangles[0];
  EXPECT_LT(glm::distance(built.mesh.normals[t.normal[1]], dvec3(0, 0, 1)), kSomeRoundings);
  EXPECT_LT(glm::distance(built.mesh.normals[t.normal[2]], dvec3(0, 0, 1)), kSomeRoundings);
}

TEST(BuildMesh, DropsTrianglesWithoutAreaAndKeepsSlivers) {
  const BuiltMesh built = build(
      "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1e-6 0\n"
      "f 1 2 3\nf 1 1 2\nf 1 2 4\nf 1 2 5\n");
  EXPECT_EQ(built.report.degenerate_dropped, 2U);
  EXPECT_EQ(built.report.triangles, 2U);
  EXPECT_THROW(build("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), InputError);
}

TEST(BuildMesh, CountsHardOpenNonManifoldAndFlippedEdges) {
  // Two triangles with different normals along their common edge.
  const BuiltMesh stress = build(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1\nvn 0 1 1\nf 1//1 2//1 3//1\nf 2//2 4//1 "
      "3//1\n");
  EXPECT_EQ(stress.report.hard_edges, 1U);
  EXPECT_EQ(stress.report.open_edges, 4U);
  // Three triangles on the edge 1-2.
  const BuiltMesh fin =
      build("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n");
  EXPECT_EQ(fin.report.non_manifold_edges, 1U);
  EXPECT_EQ(fin.report.open_edges, 6U);
  // The second triangle is wound the other way, against its normals.
  const BuiltMesh flipped =
      build("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf 3//1 4//1 2//1\n");
  EXPECT_EQ(flipped.report.flipped_edges, 1U);
  EXPECT_EQ(flipped.report.normals_behind, 3U);
}

TEST(BuildMesh, CreaseAngleSplitsOrJoinsNormals) {
  EXPECT_EQ(build(kCube, {.crease_degrees = 89.0}).report.hard_edges, 12U);
  EXPECT_EQ(build(kCube, {.crease_degrees = 91.0}).report.hard_edges, 0U);
  // The file's own normals give way.
  const std::string sheet = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 1\nf 1//1 2//1 3//1\n";
  const BuiltMesh rebuilt = build(sheet, {.crease_degrees = 30.0});
  EXPECT_EQ(rebuilt.report.normals, NormalSource::welded);
  EXPECT_EQ(rebuilt.mesh.normals[rebuilt.mesh.triangles[0].normal[0]], dvec3(0, 0, 1));
}

// A cone's side: so many triangles around its tip, position 0.
PolygonModel cone(uint32_t triangles) {
  PolygonModel model;
  model.positions.emplace_back(0.0, 0.0, 1.0);
  for (uint32_t i = 0; i < triangles; ++i) {
    const double angle = 6.283185307179586 * i / triangles;
    model.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    for (const uint32_t vertex : {0U, 1 + i, 1 + (i + 1) % triangles}) {
      model.corners.push_back({vertex, PolygonCorner::no_normal});
    }
  }
  model.sizes.assign(triangles, 3);
  return model;
}

// Around a vertex with very many faces each face's normal is the mean of those within the crease's
// angle. (Tried each with each they would take minutes.)
TEST(BuildMesh, MakesNormalsOfVeryManyFacesAroundAVertex) {
  constexpr uint32_t faces = 400000;
  constexpr double crease = 20.0;
  const BuiltMesh built = build_mesh(cone(faces), "cone", {.crease_degrees = crease});
  ASSERT_EQ(built.report.triangles, faces);
  // The faces' normals are as high as they are wide. Those counted are within `width` on both
  // sides.
  const double width = std::acos(2.0 * std::cos(glm::radians(crease)) - 1.0);
  const double slope = width / std::sin(width);
  for (uint32_t i = 0; i < faces; i += 1000) {
    const dvec3 normal = built.mesh.normals[built.mesh.triangles[i].normal[0]];
    const double angle = 6.283185307179586 * (i + 0.5) / faces;
    const double across = normal.x * std::cos(angle) + normal.y * std::sin(angle);
    EXPECT_NEAR(normal.z / across, slope, 1e-4) << i;
    EXPECT_NEAR(normal.y * std::cos(angle) - normal.x * std::sin(angle), 0.0, 1e-4) << i;
  }
}

TEST(BuildMesh, LeavesVeryManyFacesAroundAVertexFlatWithoutSmoothing) {
  PolygonModel model = cone(400000);
  model.smoothing_groups.assign(model.sizes.size(), 0);
  const BuiltMesh built = build_mesh(std::move(model), "cone", {.crease_degrees = 20.0});
  for (const MeshTriangle& t : built.mesh.triangles) {
    const auto normal = [&](std::size_t i) { return built.mesh.normals[t.normal[i]]; };
    ASSERT_LT(glm::distance(normal(0), normal(1)), kSomeRoundings);
    ASSERT_LT(glm::distance(normal(0), normal(2)), kSomeRoundings);
  }
}

TEST(BuildMesh, KeepsEveryTriangleOfConvexAndConcavePolygons) {
  const BuiltMesh built = build(
      "v 0 2 0\nv -1 -1 0\nv 0 0 0\nv 1 -1 0\nv 3 0 0\nv 4 0 0\nv 4 1 0\nv 3.5 2 0\nv 3 1 0\n"
      "g a\nf 1 2 3 4\ng b\nf 5 6 7 8 9\n");
  ASSERT_EQ(built.report.triangles, 5U);
  for (const MeshTriangle& t : built.mesh.triangles) {
    const auto& p = built.mesh.positions;
    EXPECT_GT(glm::cross(p[t.vertex[1]] - p[t.vertex[0]], p[t.vertex[2]] - p[t.vertex[0]]).z, 0.0);
  }
}

// The normals at a vertex, by its position.
std::vector<dvec3> normals_at(const Mesh& mesh, const dvec3& position) {
  std::vector<dvec3> normals;
  for (const MeshTriangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (mesh.positions[t.vertex[i]] == position) normals.push_back(mesh.normals[t.normal[i]]);
    }
  }
  return normals;
}

TEST(BuildMesh, GivesSolidsThatTouchInAPointNormalsOfTheirOwn) {
  // Two tetrahedra, point to point: together the faces around the point cancel out.
  const std::string up = "v 0 0 0\nv 1 0 1\nv -1 1 1\nv -1 -1 1\n";
  const std::string down = "v 0 0 0\nv 1 0 -1\nv -1 1 -1\nv -1 -1 -1\n";
  const std::string faces_up = "f -4 -3 -2\nf -4 -2 -1\nf -4 -1 -3\nf -3 -1 -2\n";
  const std::string faces_down = "f -4 -2 -3\nf -4 -1 -2\nf -4 -3 -1\nf -3 -2 -1\n";
  const auto alone = normals_at(build(up + faces_up).mesh, dvec3(0.0));
  const auto both = normals_at(build(up + faces_up + down + faces_down).mesh, dvec3(0.0));
  ASSERT_EQ(alone.size(), 3U);
  ASSERT_EQ(both.size(), 6U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(both[i], alone[0]);
    EXPECT_LT(glm::distance(both[i + 3], alone[0] * dvec3(1, 1, -1)), kSomeRoundings);
  }
}

TEST(BuildMesh, KeepsSmoothingGroupsApart) {
  // The faces of kCube, the first two and the last four of a group each, and each of its own.
  const auto with_groups = [&](const std::vector<std::string>& groups) {
    std::string text = kCube;
    std::size_t at = 0;
    for (const std::string& group : groups) {
      at = text.find("\nf ", at) + 1;
      if (!group.empty()) text.insert(at, "s " + group + "\n");
      at = text.find("f ", at);
    }
    return build(text).report;
  };
  EXPECT_EQ(with_groups({"1", "", "", "", "", ""}).hard_edges, 0U);
  EXPECT_EQ(with_groups({"1", "2", "4", "8", "16", "32"}).hard_edges, 12U);
  // The diagonals of the faces too: each triangle is flat, but a face's two lie in one plane.
  EXPECT_EQ(with_groups({"off", "", "", "", "", ""}).hard_edges, 12U);
  // A can: the sides are smooth among themselves.
  EXPECT_EQ(with_groups({"1", "2", "3", "", "", ""}).hard_edges, 8U);
}

TEST(BuildMesh, PassesOverRepeatedCornersAndSpikes) {
  const std::string dart = "v -3 0 0\nv 3 1 0\nv 0 6 0\nv -1 1 0\nv 9 9 0\n";
  const auto area_of = [](const BuiltMesh& built) {
    double area = 0.0;
    for (const MeshTriangle& t : built.mesh.triangles) {
      const auto& p = built.mesh.positions;
      area += glm::cross(p[t.vertex[1]] - p[t.vertex[0]], p[t.vertex[2]] - p[t.vertex[0]]).z / 2.0;
    }
    return area;
  };
  const double area = area_of(build(dart + "f 1 2 3 4\n"));
  for (const char* face : {"f 1 2 3 3 4 1", "f 1 1 1 2 3 4 4", "f 1 2 5 2 3 4", "f 1 2 3 4 5 4",
                           "f 5 1 2 3 4 1", "f 1 2 5 5 2 2 3 4 1 1"}) {
    const BuiltMesh built = build(dart + face + "\n");
    EXPECT_EQ(built.report.triangles, 2U) << face;
    EXPECT_EQ(built.report.degenerate_dropped, 0U) << face;
    EXPECT_NEAR(area_of(built), area, kSomeRoundings) << face;
  }
  EXPECT_EQ(build(dart + "f 1 2 3\nf 1 2 1 2\nf 1 2 3 2\n").report.degenerate_dropped, 2U);
}

TEST(BuildMesh, WeldsVerticesThatAreCloseOnDemand) {
  // The second triangle's copies are off by a millionth, on either side of a cell's border.
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 0.999999 -0.000001 0\nv 1 1 1\nv 0 1.000001 0\nf 4 5 "
      "6\n";
  EXPECT_EQ(build(text).report.open_edges, 6U);
  EXPECT_EQ(build(text, {.weld = 1e-7}).report.open_edges, 6U);
  const BuiltMesh welded = build(text, {.weld = 1e-5});
  EXPECT_EQ(welded.report.open_edges, 4U);
  EXPECT_EQ(welded.report.vertices, 4U);
  EXPECT_EQ(welded.mesh.positions[1], dvec3(1, 0, 0));
}

TEST(BuildMesh, WeldsVerticesInAnyTwoCellsThatTouch) {
  const double distance = 0.125;
  for (int i = 0; i < 27; ++i) {
    // On both sides of the face, edge or corner of the cell of (8.5, 8.5, 8.5), or twice within it.
    const dvec3 side(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    std::string text = "v 0 0 0\nv 1 0 0\nv 3 0 0\nv 0 5 0\n";
    for (const double at : {0.45, 0.55}) {
      const dvec3 p = (dvec3(8.5) + side * at) * distance;
      text +=
          "v " + std::to_string(p.x) + ' ' + std::to_string(p.y) + ' ' + std::to_string(p.z) + '\n';
    }
    text += "f 1 2 5\nf 3 4 6\n";
    EXPECT_EQ(build(text, {.weld = distance}).report.vertices, 5U) << i;
  }
}

TEST(BuildMesh, RepairsWindingOnDemand) {
  const std::string cube = kCube;
  // One face turned: its two triangles.
  std::string text = cube;
  text.replace(text.find("f 5 6 7 8"), 9, "f 8 7 6 5");
  EXPECT_EQ(build(text).report.flipped_edges, 4U);
  const BuiltMesh repaired = build(text, {.repair = true});
  EXPECT_EQ(repaired.report.flipped_edges, 0U);
  EXPECT_EQ(repaired.report.turned, 2U);
  EXPECT_EQ(build(cube, {.repair = true}).report.turned, 0U);
  // Inside out all over, which its edges do not tell.
  std::string inside_out = cube.substr(0, cube.find("f "));
  inside_out += "f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n";
  EXPECT_EQ(build(inside_out).report.flipped_edges, 0U);
  EXPECT_EQ(build(inside_out, {.repair = true}).report.turned, 12U);
  // Of an open strip the one that differs.
  const std::string strip =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 2 0\nf 1 2 3\nf 2 3 4\nf 3 4 5\n";
  const BuiltMesh straight = build(strip, {.repair = true});
  EXPECT_EQ(straight.report.turned, 1U);
  EXPECT_EQ(straight.report.flipped_edges, 0U);
}

TEST(BuildMesh, DescribesItselfInOneLine) {
  EXPECT_EQ(describe(build(kCube).report),
            "12 triangles, 8 vertices, normals angle-weighted over welded vertices, 0 degenerate "
            "triangles dropped, 0 hard edges, 0 open edges, 0 non-manifold edges");
  EXPECT_EQ(describe(build("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n").report),
            "1 triangles, 3 vertices, normals angle-weighted over welded vertices, 0 degenerate "
            "triangles dropped, 0 hard edges, 3 open edges, 0 non-manifold edges, 1 line element "
            "left out");
}

// The triangles of a polygon have its colour, also where others were left out before them.
TEST(BuildMesh, KeepsColours) {
  PolygonModel model =
      parse_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 1 2\nf 1 2 3 4\nf 1 2 3\n", "model.obj");
  const glm::vec3 red(1, 0, 0);
  model.colors = {glm::vec3(0, 0, 1), red, PolygonModel::no_color};
  const BuiltMesh built = build_mesh(model, "model.obj");
  EXPECT_EQ(built.report.degenerate_dropped, 1U);
  EXPECT_EQ(built.mesh.colors, (std::vector<glm::vec3>{red, red, PolygonModel::no_color}));
  EXPECT_EQ(built.report.colored, 2U);
  model.colors.assign(3, PolygonModel::no_color);
  EXPECT_TRUE(build_mesh(model, "model.obj").mesh.colors.empty());
}

}  // namespace
}  // namespace trisect
