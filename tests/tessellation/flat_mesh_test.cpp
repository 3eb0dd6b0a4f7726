// The curved surface as flat triangles: watertight, and as close as it says.
#include "app/tessellation/flat_mesh.h"

#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "app/bake/subpatch_bounds.h"
#include "app/base/atomic_file.h"
#include "app/base/error.h"
#include "app/dispatch/cpu_tracer.h"
#include "app/dispatch/kernel_float.h"
#include "app/dispatch/trace_settings.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "app/surface/patch_range.h"
#include "app/tessellation/flat_mesh_file.h"
#include "app/trace/trace_scene.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace trisect {
namespace {

using glm::dvec3;
using glm::vec3;

// A ray tracer of its own over flat triangles.
class Traced {
 public:
  explicit Traced(const std::vector<vec3>& positions, const std::vector<glm::uvec3>& triangles)
      : positions_(positions), triangles_(triangles), device_(rtcNewDevice(nullptr)) {
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), positions.size()));
    std::copy(positions.begin(), positions.end(), vertices);
    auto* indices = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), triangles.size()));
    std::copy(triangles.begin(), triangles.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~Traced() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Traced(const Traced&) = delete;
  Traced& operator=(const Traced&) = delete;
  Traced(Traced&&) = delete;
  Traced& operator=(Traced&&) = delete;

  // Along a ray; infinite where it meets nothing.
  [[nodiscard]] float distance_along(const vec3& from, const vec3& way) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray = {from.x, from.y, from.z,
               0.0F,   way.x,  way.y,
               way.z,  0.0F,   std::numeric_limits<float>::infinity(),
               ~0U,    0,      0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &ray);
    return ray.ray.tfar;
  }

  // Of a point from the nearest triangle.
  [[nodiscard]] double distance(const dvec3& point) const {
    Nearest nearest{this, point, std::numeric_limits<double>::infinity()};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    const vec3 at(point);
    RTCPointQuery query{at.x, at.y, at.z, 0.0F, std::numeric_limits<float>::infinity()};
    rtcPointQuery(scene_, &query, &context, look_at, &nearest);
    return nearest.distance;
  }

 private:
  struct Nearest {
    const Traced* traced;
    dvec3 point;
    double distance;
  };

  static bool look_at(RTCPointQueryFunctionArguments* arguments) {
    auto& nearest = *static_cast<Nearest*>(arguments->userPtr);
    const glm::uvec3& t = nearest.traced->triangles_[arguments->primID];
    const auto corner = [&](int k) { return dvec3(nearest.traced->positions_[t[k]]); };
    const double d = distance_to_triangle(nearest.point, corner(0), corner(1), corner(2));
    if (d >= nearest.distance) return false;
    nearest.distance = d;
    arguments->query->radius = std::nextafter(static_cast<float>(d), 1e30F);
    return true;
  }

  static double distance_to_segment(const dvec3& p, const dvec3& a, const dvec3& b) {
    const double length = glm::dot(b - a, b - a);
    const double t = length > 0.0 ? std::clamp(glm::dot(p - a, b - a) / length, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + (b - a) * t);
  }

  static double distance_to_triangle(const dvec3& p, const dvec3& a, const dvec3& b,
                                     const dvec3& c) {
    const dvec3 n = glm::cross(b - a, c - a);
    const double nn = glm::dot(n, n);
    if (nn > 0.0) {
      const double v = glm::dot(glm::cross(p - a, c - a), n) / nn;
      const double w = glm::dot(glm::cross(b - a, p - a), n) / nn;
      if (v >= 0.0 && w >= 0.0 && v + w <= 1.0) {
        return std::abs(glm::dot(p - a, n)) / std::sqrt(nn);
      }
    }
    return std::min(
        {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  }

  const std::vector<vec3>& positions_;
  const std::vector<glm::uvec3>& triangles_;
  RTCDevice device_;
  RTCScene scene_ = nullptr;
};

std::vector<vec3> rounded(const std::vector<dvec3>& positions) {
  return {positions.begin(), positions.end()};
}

// A model of assets, closed, with a surface.
struct Model {
  Mesh mesh;
  BakedScene scene;

  Model(const std::string& asset, uint surface)
      : mesh(test::without_holes(test::load_asset(asset))),
        scene(bake(mesh, {surface, 0.65, SHELL_NORMAL})) {}
};

// The surface's own points are within the bound of the triangles, and theirs of the surface: of so
// fine a mesh that its bound hardly counts.
void expect_close(const Model& model, const FlatMesh& flat) {
  const std::vector<vec3> positions = rounded(flat.positions);
  const Traced traced(positions, flat.triangles);
  const in_double::Shape shape = shape_of(model.scene.choice);
  double rounding = 0.0;
  for (const dvec3& p : flat.positions) rounding = std::max(rounding, glm::length(p) * 6e-8);
  double farthest = 0.0;
  for (const Triangle& baked : model.scene.triangles) {
    const in_double::Triangle tri = to_double(baked);
    for (const dvec3& w : test::weight_grid(17)) {
      const dvec3 point = model.scene.origin + in_double::surface_point(shape, tri, w);
      farthest = std::max(farthest, traced.distance(point));
    }
  }
  EXPECT_LE(farthest, flat.bound + rounding);
  const FlatMesh fine = *divided_evenly(model.mesh, model.scene, 40);
  const std::vector<vec3> fine_positions = rounded(fine.positions);
  const Traced surface(fine_positions, fine.triangles);
  double away = 0.0;
  for (const glm::uvec3& t : flat.triangles) {
    const dvec3 centre = (flat.positions[t.x] + flat.positions[t.y] + flat.positions[t.z]) / 3.0;
    away = std::max(away, surface.distance(centre));
  }
  EXPECT_LE(away, flat.bound + fine.bound + 2.0 * rounding);
}

TEST(FlatMesh, IsClosedAndAsCloseAsItSays) {
  for (const std::string asset : {"sphere-20", "torus", "capsule", "cube"}) {
    for (const uint surface : {SURFACE_PHONG, SURFACE_SPHERE}) {
      SCOPED_TRACE(asset + " " + surface_name(surface));
      const Model model(asset, surface);
      const double error = 0.01 * model.scene.extent;
      const std::optional<FlatMesh> flat = divided_to(model.mesh, model.scene, error);
      ASSERT_TRUE(flat);
      EXPECT_LE(flat->bound, error);
      EXPECT_EQ(flat->beyond_error, 0U);
      EXPECT_EQ(count_open_edges(*flat), 0U);
      expect_close(model, *flat);
    }
  }
}

// Where there is no proof as small as that the bound says so, and holds.
TEST(FlatMesh, SaysWhereItsBoundIsLarger) {
  const Model model("teapot", SURFACE_SPHERE);
  const double error = 0.02 * model.scene.extent;
  const std::optional<FlatMesh> flat = divided_to(model.mesh, model.scene, error);
  ASSERT_TRUE(flat);
  EXPECT_GT(flat->bound, error);
  EXPECT_GT(flat->beyond_error, 0U);
  EXPECT_LT(flat->beyond_error, flat->triangles.size() / 4);
  EXPECT_EQ(count_open_edges(*flat), 0U);
  expect_close(model, *flat);
}

TEST(FlatMesh, TakesTrianglesWhereTheSurfaceBends) {
  const Model model("teapot", SURFACE_PHONG);
  const FlatMesh even = *divided_evenly(model.mesh, model.scene, 8);
  const std::optional<FlatMesh> fitted = divided_to(model.mesh, model.scene, 1.01 * even.bound);
  ASSERT_TRUE(fitted);
  EXPECT_LT(fitted->triangles.size() * 2, even.triangles.size());
  // And one that is flat as it is keeps its own.
  const Model cube("cube", SURFACE_PHONG);
  EXPECT_EQ(divided_to(cube.mesh, cube.scene, 1e-5)->triangles.size(), 12U);
}

TEST(FlatMesh, DividesEvenly) {
  const Model model("torus", SURFACE_PHONG);
  const std::size_t patches = model.scene.triangles.size();
  double before = std::numeric_limits<double>::infinity();
  for (const uint32_t n : {1U, 2U, 3U, 8U}) {
    const FlatMesh flat = *divided_evenly(model.mesh, model.scene, n);
    EXPECT_EQ(flat.triangles.size(), patches * n * n);
    // Of a closed mesh of genus 1: vertices - edges + triangles = 0, 3 triangles = 2 edges.
    EXPECT_EQ(flat.positions.size(), flat.triangles.size() / 2);
    EXPECT_EQ(flat.normals.size(), flat.positions.size());
    EXPECT_EQ(count_open_edges(flat), 0U);
    EXPECT_LT(flat.bound, before);
    before = flat.bound;
    for (std::size_t t = 0; t < flat.triangles.size(); ++t) {
      EXPECT_EQ(flat.patches[t], t / (std::size_t{n} * n));
    }
  }
  EXPECT_THROW(divided_evenly(model.mesh, model.scene, 4000), InputError);
}

// Two triangles between the same three vertices, back to back: one surface, closed.
TEST(FlatMesh, DividesPatchesWithTheSameCornersAlike) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const dvec3& n : {dvec3(-0.4, -0.4, 1.0), dvec3(0.5, -0.1, 1.0), dvec3(-0.1, 0.5, 1.0)}) {
    mesh.normals.push_back(glm::normalize(n));
  }
  mesh.triangles = {{{0, 1, 2}, {0, 1, 2}}, {{0, 2, 1}, {0, 2, 1}}};
  const BakedScene scene = bake(mesh, {SURFACE_SPHERE, 0.0, SHELL_NORMAL});
  const std::optional<FlatMesh> flat = divided_to(mesh, scene, 1e-3);
  ASSERT_TRUE(flat);
  EXPECT_LE(flat->bound, 1e-3);
  EXPECT_EQ(count_open_edges(*flat), 0U);
}

// Opposite normals cancel out on the way between them: there is no surface there, and no NaN.
TEST(FlatMesh, WritesNoNaN) {
  const Mesh mesh = test::one_triangle({dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(0, 1, 0)},
                                       {dvec3(0, 0, 1), dvec3(0, 0, -1), dvec3(0, 1, 0)});
  const BakedScene scene = bake(mesh, {SURFACE_SPHERE, 0.0, SHELL_NORMAL});
  const FlatMesh flat = *divided_evenly(mesh, scene, 2);
  for (std::size_t v = 0; v < flat.positions.size(); ++v) {
    EXPECT_TRUE(std::isfinite(glm::dot(flat.positions[v], flat.positions[v])));
    EXPECT_TRUE(std::isfinite(glm::dot(flat.normals[v], flat.normals[v])));
  }
  EXPECT_TRUE(std::isinf(flat.bound));
  EXPECT_EQ(count_open_edges(flat), 6U);
}

// A hard edge that stays straight: its sides have vertices of their own, at the same places.
TEST(FlatMesh, KeepsHardEdgesClosedThatStayStraight) {
  const Model smooth("sphere-20", SURFACE_PHONG);
  Mesh mesh = smooth.mesh;
  // One triangle with its own flat normal: its neighbours curve away from its straight sides.
  const MeshTriangle& t = mesh.triangles[0];
  const dvec3 n =
      glm::normalize(glm::cross(mesh.positions[t.vertex[1]] - mesh.positions[t.vertex[0]],
                                mesh.positions[t.vertex[2]] - mesh.positions[t.vertex[0]]));
  mesh.normals.push_back(n);
  const auto flat_normal = static_cast<uint32_t>(mesh.normals.size() - 1);
  mesh.triangles[0].normal = {flat_normal, flat_normal, flat_normal};
  const auto flat_beside_curved = divided_to(mesh, bake(mesh, smooth.scene.choice), 0.01);
  EXPECT_GT(count_open_edges(*flat_beside_curved), 0U);
  // All of them flat: as the whole is divided, so is each side of an edge.
  Mesh cube = test::load_asset("cube");
  const FlatMesh divided = *divided_evenly(cube, bake(cube, smooth.scene.choice), 7);
  EXPECT_EQ(count_open_edges(divided), 0U);
  EXPECT_GT(divided.positions.size(), divided.triangles.size() / 2 + 2);
}

// Normals of a file that are not the same to the last digit, as programs write them.
Mesh with_normals_apart(const Mesh& smooth, double by) {
  Mesh mesh = smooth;
  mesh.normals.clear();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (MeshTriangle& t : mesh.triangles) {
    for (uint32_t& n : t.normal) {
      const dvec3 off(unit(random), unit(random), unit(random));
      mesh.normals.push_back(glm::normalize(smooth.normals[n] + off * by));
      n = static_cast<uint32_t>(mesh.normals.size() - 1);
    }
  }
  return mesh;
}

TEST(FlatMesh, IsClosedWhereNormalsDifferInTheLastDigit) {
  for (const std::string asset : {"sphere-20", "torus"}) {
    for (const uint surface : {SURFACE_PHONG, SURFACE_SPHERE}) {
      SCOPED_TRACE(asset + " " + surface_name(surface));
      const Mesh smooth = test::load_asset(asset);
      // Apart by less than kSameNormal (1.7 times by, twice), so that vertices are the same; by
      // somewhat more, so that only their positions are.
      for (const double by : {2e-7, 8e-7}) {
        const Mesh mesh = with_normals_apart(smooth, by);
        const BakedScene scene = bake(mesh, {surface, 0.65, SHELL_NORMAL});
        const std::optional<FlatMesh> flat = divided_to(mesh, scene, 0.01 * scene.extent);
        ASSERT_TRUE(flat);
        EXPECT_EQ(flat->beyond_error, 0U);
        EXPECT_EQ(count_open_edges(*flat), 0U);
        EXPECT_GT(flat->off, 1e-9);
        EXPECT_LT(flat->off, 1e-5 * scene.extent);
        const FlatMesh even = *divided_evenly(mesh, scene, 5);
        EXPECT_EQ(count_open_edges(even), 0U);
        if (by < 3e-7) {
          EXPECT_LE(even.positions.size(), even.triangles.size() / 2 + 2);
        }
      }
    }
  }
}

// The surface has its vertices in single precision, the mesh that is written in double: no division
// brings them nearer.
TEST(FlatMesh, DividesNothingForWhatRoundingMoves) {
  const Model flat("teapot", SURFACE_FLAT);
  const std::optional<FlatMesh> as_it_is = divided_to(flat.mesh, flat.scene, 1e-9);
  ASSERT_TRUE(as_it_is);
  EXPECT_EQ(as_it_is->triangles.size(), flat.mesh.triangles.size());
  EXPECT_GT(as_it_is->beyond_error, 0U);
  EXPECT_GT(as_it_is->off, 1e-8);
  EXPECT_LT(as_it_is->off, 1e-6);
  // One that bends a little is divided until its bend is less than that.
  const Mesh mesh = test::load_asset("sphere-20");
  const BakedScene scene = bake(mesh, {SURFACE_PHONG, 2e-5, SHELL_NORMAL});
  const std::optional<FlatMesh> finest = divided_to(mesh, scene, 1e-9);
  ASSERT_TRUE(finest);
  EXPECT_GT(finest->triangles.size(), 1000U);
  EXPECT_GT(finest->bound, 1.02 * finest->off);
  EXPECT_LE(finest->bound, 1.25 * finest->off);
}

TEST(FlatMesh, StopsWhenItIsTold) {
  const Model model("torus", SURFACE_PHONG);
  for (const int after : {0, 1, 5}) {
    int asked = 0;
    const FractionProgress keep_going = [&](double) { return asked++ < after; };
    EXPECT_FALSE(divided_to(model.mesh, model.scene, 1e-4, keep_going));
    EXPECT_EQ(asked, after + 1);
    asked = 0;
    EXPECT_FALSE(divided_evenly(model.mesh, model.scene, 20, keep_going));
    EXPECT_EQ(asked, after + 1);
  }
}

TEST(FlatMesh, TellsWhichPartIsDone) {
  const Model model("torus", SURFACE_PHONG);
  std::vector<double> told;
  const FractionProgress progress = [&](double done) {
    told.push_back(done);
    return true;
  };
  const auto expect_risen = [&] {
    ASSERT_GE(told.size(), 4U);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_GE(told.front(), 0.0);
    EXPECT_LE(told.back(), 1.0);
    EXPECT_GE(told.back(), 0.5);
    told.clear();
  };
  ASSERT_TRUE(divided_to(model.mesh, model.scene, 1e-3, progress));
  expect_risen();
  ASSERT_TRUE(divided_evenly(model.mesh, model.scene, 20, progress));
  expect_risen();
}

// What another program makes of the file: where our frame has a hit it has a surface within the
// bound, and it has hits where ours has, but for pixels at silhouettes.
TEST(FlatMeshFile, IsTheFrameThatWeTrace) {
  const test::TemporaryFolder folder;
  for (const std::string asset : {"sphere-20", "torus", "capsule"}) {
    for (const uint surface : {SURFACE_PHONG, SURFACE_SPHERE}) {
      SCOPED_TRACE(asset + " " + surface_name(surface));
      const Mesh mesh = test::load_asset(asset);
      const BakedScene scene = bake_with_subpatches(mesh, {surface, 0.65, SHELL_NORMAL});
      const double error = 1e-3 * scene.extent;
      const std::optional<FlatMesh> flat = divided_to(mesh, scene, error);
      AtomicFile file(folder / "surface.ply");
      write_mesh(*flat, MeshFormat::ply, file);
      file.commit();
      const Mesh read = build_mesh(read_model(folder / "surface.ply"), "surface.ply").mesh;
      std::vector<vec3> positions;
      for (const dvec3& p : read.positions) positions.emplace_back(p - scene.origin);
      std::vector<glm::uvec3> triangles;
      for (const MeshTriangle& t : read.triangles) {
        triangles.emplace_back(t.vertex[0], t.vertex[1], t.vertex[2]);
      }
      ASSERT_EQ(triangles.size(), flat->triangles.size());
      const Traced traced(positions, triangles);
      const TraceParams params = make_params(scene, framed_settings(mesh, scene, 160, 120));
      const Frame frame =
          trace_scene({.backend = Backend::cpu}, scene, params, {.aovs = true})->frame;
      in_float::Kernel kernel = in_float::kernel_of(scene, params, {});
      const double rounding = file_rounding(mesh, scene, MeshFormat::ply) + 1e-6 * scene.extent;
      std::size_t hits = 0;
      std::size_t others = 0;
      double farthest = 0.0;
      for (uint32_t y = 0; y < 120; ++y) {
        for (uint32_t x = 0; x < 160; ++x) {
          const auto ray = kernel.pixel_ray({x, y});
          const float along = traced.distance_along(ray.near_point, ray.view);
          const PixelAovs& aovs = frame.aovs[std::size_t{y} * 160 + x];
          const bool hit = aovs.triangle != NO_TRIANGLE;
          others += hit != std::isfinite(along) ? 1 : 0;
          if (!hit) continue;
          ++hits;
          const dvec3 point =
              dvec3(ray.near_point) +
              dvec3(ray.view) * static_cast<double>(aovs.normal_z.w - ray.near_distance);
          farthest = std::max(farthest, traced.distance(point));
        }
      }
      EXPECT_GT(hits, 1000U);
      EXPECT_LT(others, hits / 100);
      EXPECT_LE(farthest, flat->bound + rounding);
      // Not because the bound is far from the truth.
      EXPECT_GT(farthest, flat->bound / 50.0);
    }
  }
}

TEST(FlatMeshFile, EveryFormatHasTheSameSurface) {
  const test::TemporaryFolder folder;
  // Off the origin, so that roundings show.
  Mesh mesh = test::load_asset("cube");
  for (dvec3& p : mesh.positions) p += dvec3(1000.1, -20.3, 5.7);
  const BakedScene scene = bake(mesh, {SURFACE_PHONG, 0.65, SHELL_NORMAL});
  const FlatMesh flat = *divided_evenly(mesh, scene, 3);
  for (const std::string name : {"a.obj", "a.PLY", "a.stl", "a.glb"}) {
    SCOPED_TRACE(name);
    const std::optional<MeshFormat> format = mesh_format_of(name);
    ASSERT_TRUE(format);
    AtomicFile file(folder / name);
    write_mesh(flat, *format, file);
    file.commit();
    const PolygonModel model = read_model(folder / name);
    ASSERT_EQ(model.sizes.size(), flat.triangles.size());
    const double rounding = file_rounding(mesh, scene, *format);
    EXPECT_LT(rounding, *format == MeshFormat::obj ? 1e-6 : 1e-4);
    for (std::size_t t = 0; t < flat.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const PolygonCorner& corner = model.corners[3 * t + k];
        const uint32_t vertex = flat.triangles[t][static_cast<int>(k)];
        EXPECT_LE(glm::distance(model.positions[corner.position], flat.positions[vertex]),
                  rounding);
        if (*format == MeshFormat::stl) continue;
        EXPECT_LE(glm::distance(model.normals[corner.normal], dvec3(flat.normals[vertex])), 1e-6);
      }
    }
    const BuiltMesh built = build_mesh(model, name);
    EXPECT_EQ(built.report.open_edges, 0U);
    EXPECT_EQ(built.report.degenerate_dropped, 0U);
  }
  // In OBJ the places of hard edges are one vertex.
  EXPECT_EQ(read_model(folder / "a.obj").positions.size(), 6U * 9U + 2U);
  EXPECT_FALSE(mesh_format_of("a.fbx"));
  EXPECT_FALSE(mesh_format_of("obj"));
}

}  // namespace
}  // namespace trisect
