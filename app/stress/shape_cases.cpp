// Hard shapes: one or a few patches, with rays from all directions.
#include <cmath>
#include <limits>
#include <utility>

#include "app/mesh/mesh_builder.h"
#include "app/mesh/obj_file.h"
#include "app/stress/stress_cases.h"
#include "app/stress/stress_scenes.h"

namespace trisect {
namespace {

using glm::dvec3;

const dvec3 kUp(0, 0, 1);

RayCase shape(std::string name, std::string what, std::function<Mesh()> mesh, int count = 240) {
  RayCase ray_case;
  ray_case.name = std::move(name);
  ray_case.what = std::move(what);
  ray_case.mesh = std::move(mesh);
  ray_case.rays = [count](const BakedScene& scene, std::mt19937_64& random) {
    return stress::rays_at_surface(scene, random, count);
  };
  return ray_case;
}

// +z turned by `degrees` toward a direction in the xy plane.
dvec3 tilted(double degrees, const dvec3& toward) {
  const double angle = glm::radians(degrees);
  return kUp * std::cos(angle) + glm::normalize(toward) * std::sin(angle);
}

// plain_patch() whose first normals, so many of them, lean by `degrees` away from the middle of the
// triangle; the others are upright. Beside it a patch that has a surface in every shell.
Mesh reclined(int corners, double degrees) {
  const std::array<dvec3, 3> away{dvec3(-1, -0.3, 0), dvec3(1, -0.4, 0), dvec3(0.1, 1, 0)};
  stress::Corners normals{kUp, kUp, kUp};
  for (std::size_t k = 0; k < static_cast<std::size_t>(corners); ++k) {
    // Exactly in the plane at 90 degrees.
    normals[k] = degrees == 90.0 ? glm::normalize(away[k]) : tilted(degrees, away[k]);
  }
  return stress::joined(stress::plain_patch(normals), stress::leaning_patch(20.0),
                        dvec3(0.3, 0.2, -0.5));
}

// The same with normals in the plane but for a part along the face normal, up or down.
Mesh a_hair_off_the_plane(double along) {
  const stress::Corners normals{dvec3(-1, -0.25, along), dvec3(1, -0.5, -along), kUp};
  return stress::joined(stress::plain_patch(normals), stress::leaning_patch(20.0),
                        dvec3(0.3, 0.2, -0.5));
}

Mesh sliver(double aspect) {
  const double thin = 2.0 / aspect;
  return stress::patch({dvec3(-1, 0, 0), dvec3(1, 0, 0), dvec3(0.1, thin, 0)},
                       {tilted(30, dvec3(-1, 0, 0)), tilted(30, dvec3(1, 0, 0)), kUp});
}

// One patch whose normals lean by 1 degree, and two for each lean from 1e-2 to 1e-8 degrees,
// outward and inward.
Mesh almost_flat() {
  Mesh mesh = stress::leaning_patch(1.0);
  double place = 0.0;
  for (const double tilt : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8}) {
    place += 2.5;
    mesh = stress::joined(mesh, stress::leaning_patch(tilt), dvec3(place, 0, 0));
    mesh = stress::joined(mesh, stress::leaning_patch(-tilt), dvec3(place, 2, 0));
  }
  return mesh;
}

// A cube whose faces bulge. Faces do not share their normals, so its edges stay sharp.
Mesh pillow_cube() {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      dvec3 n(0.0);
      n[axis] = side;
      const dvec3 u(n.z, n.x, n.y);
      const dvec3 v = glm::cross(n, u);
      const std::array<dvec3, 4> corners{n - u - v, n + u - v, n + u + v, n - u + v};
      for (const auto& [b, c] : {std::pair<std::size_t, std::size_t>{1, 2}, {2, 3}}) {
        const stress::Corners p{corners[0], corners[b], corners[c]};
        const Mesh half = stress::patch(p, {n * 2.0 + p[0], n * 2.0 + p[1], n * 2.0 + p[2]});
        mesh = stress::joined(mesh, half, dvec3(0.0));
      }
    }
  }
  return mesh;
}

// Three patches that share the edge from -x to x.
Mesh three_leaves() {
  const dvec3 a(-1, 0, 0);
  const dvec3 b(1, 0, 0);
  Mesh mesh;
  for (int leaf = 0; leaf < 3; ++leaf) {
    const double angle = glm::radians(40.0 + 110.0 * leaf);
    const dvec3 out(0, std::cos(angle), std::sin(angle));
    const dvec3 n = glm::cross(b - a, out);
    mesh = stress::joined(mesh, stress::patch({a, b, out}, {n + a, n + b, n + out}), dvec3(0.0));
  }
  return mesh;
}

Mesh every_other_face_turned() {
  Mesh mesh = stress::sphere();
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 2) {
    std::swap(mesh.triangles[t].vertex[1], mesh.triangles[t].vertex[2]);
    std::swap(mesh.triangles[t].normal[1], mesh.triangles[t].normal[2]);
  }
  return mesh;
}

// The same patch twice, once more with its winding reversed, and one that is moved in its plane and
// overlaps them.
Mesh coincident() {
  const Mesh once = stress::leaning_patch(25.0);
  Mesh turned = once;
  std::swap(turned.triangles[0].vertex[1], turned.triangles[0].vertex[2]);
  std::swap(turned.triangles[0].normal[1], turned.triangles[0].normal[2]);
  const Mesh twice = stress::joined(once, once, dvec3(0.0));
  return stress::joined(stress::joined(twice, turned, dvec3(0.0)), once, dvec3(0.4, 0.2, 0.0));
}

// A tetrahedron in a file that also has faces without area: collinear corners, coincident corners.
Mesh with_faces_of_no_area() {
  const std::string text =
      "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\nv 0 0 1\nv 1 1 1\n"
      "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 1 2 5\nf 1 6 4\nf 1 1 3\n";
  return build_mesh(parse_obj(text, "no-area"), "no-area").mesh;
}

std::vector<CastRay> rays_next_to_vertices(const BakedScene& scene, std::mt19937_64& random) {
  std::vector<CastRay> rays;
  for (const double away : {0.0, 1e-6, 1e-4, 1e-3}) {
    for (int i = 0; i < 60; ++i) {
      dvec3 weights(0.4 * away, 0.6 * away, 0.0);
      std::swap(weights.z, weights[i % 3]);
      weights[i % 3 == 2 ? 2 : i % 3] = 0.0;
      weights[i % 3] = 1.0 - (weights.x + weights.y + weights.z);
      const auto point = stress::point_at(
          scene, static_cast<uint32_t>(random() % scene.triangles.size()), weights);
      rays.push_back(stress::ray_through(scene, point.position, stress::any_direction(random)));
    }
  }
  return rays;
}

std::vector<CastRay> rays_next_to_border(const BakedScene& scene, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.05, 0.95);
  std::vector<CastRay> rays;
  for (const double inside : {1e-2, 1e-4, 1e-5, -1e-5, -1e-4, -1e-2}) {
    for (int i = 0; i < 40; ++i) {
      const double along = unit(random);
      const dvec3 w(inside, along * (1.0 - inside), (1.0 - along) * (1.0 - inside));
      const dvec3 weights = i % 3 == 0   ? w
                            : i % 3 == 1 ? dvec3(w.z, w.x, w.y)
                                         : dvec3(w.y, w.z, w.x);
      const auto point = stress::point_at(scene, 0, weights);
      rays.push_back(stress::ray_through(scene, point.position, stress::any_direction(random)));
    }
  }
  return rays;
}

void add_normals(std::vector<RayCase>& cases) {
  cases.push_back(shape("flat-patch", "every normal is the face's", [] {
    return stress::plain_patch({kUp, kUp, kUp});
  }));
  cases.back().surfaces = {SURFACE_FLAT, SURFACE_PHONG, SURFACE_SPHERE};
  cases.push_back(shape("one-tilted-normal", "one normal leans by 40 degrees", [] {
    return stress::plain_patch({kUp, tilted(40, dvec3(1, 0, 0)), kUp});
  }));
  cases.push_back(shape("concave", "normals lean inward by 35 degrees",
                        [] { return stress::leaning_patch(-35.0); }));
  cases.push_back(shape("saddle", "curvatures of both signs",
                        [] { return stress::height_grid(2, 0.5, -0.5); }));
  cases.push_back(shape("s-shaped-edge", "an edge whose ends lean the same way", [] {
    return stress::plain_patch({tilted(45, dvec3(1, 0, 0)), tilted(30, dvec3(1, 0, 0)), kUp});
  }));
  cases.push_back(shape("normals-80-apart", "two normals 80 degrees apart", [] {
    return stress::plain_patch({tilted(40, dvec3(-1, 0, 0)), tilted(40, dvec3(1, 0, 0)), kUp});
  }));
  cases.push_back(shape("normal-in-face", "a normal 89.9 degrees off the face's", [] {
    return stress::plain_patch({tilted(89.9, dvec3(-1, -0.3, 0)), kUp, kUp});
  }));
  cases.push_back(shape("normal-behind-face", "a normal 120 degrees off the face's", [] {
    return stress::plain_patch({tilted(120, dvec3(-1, -0.3, 0)), kUp, kUp});
  }));
}

// Normals in their face's plane and beyond it. The height shell divides by their part along the
// face normal: where that is nothing, it has no surface.
std::vector<RayCase> reclined_cases() {
  std::vector<RayCase> cases;
  const auto add = [&](std::string name, std::string what, std::function<Mesh()> mesh) {
    cases.push_back(shape(std::move(name), std::move(what), std::move(mesh), 120));
    cases.back().surfaces = {SURFACE_FLAT, SURFACE_PHONG, SURFACE_SPHERE};
  };
  add("normal-in-plane", "a normal at exactly 90 degrees off the face's",
      [] { return reclined(1, 90.0); });
  add("two-normals-in-plane", "two normals at exactly 90 degrees",
      [] { return reclined(2, 90.0); });
  add("normals-in-plane", "three normals at exactly 90 degrees", [] { return reclined(3, 90.0); });
  add("normals-1e-30-off", "normals in the plane but for 1e-30, above and below",
      [] { return a_hair_off_the_plane(1e-30); });
  add("normals-denormal-off", "normals in the plane but for single precision's denormals",
      [] { return a_hair_off_the_plane(1e-40); });
  add("normals-beyond-90", "three normals 93 degrees off the face's",
      [] { return reclined(3, 93.0); });
  add("normals-far-beyond-90", "two normals 150 degrees off the face's",
      [] { return reclined(2, 150.0); });
  add("normals-upside-down", "three normals 170 degrees off the face's",
      [] { return reclined(3, 170.0); });
  return cases;
}

void add_forms(std::vector<RayCase>& cases) {
  cases.push_back(shape("sliver-1e4", "10,000 times as long as wide", [] { return sliver(1e4); }));
  cases.push_back(
      shape("sliver-1e6", "1,000,000 times as long as wide", [] { return sliver(1e6); }));
  cases.push_back(shape("faces-of-no-area", "coincident vertices and collinear ones in a file",
                        with_faces_of_no_area));
  cases.push_back(shape("folded-shell", "normals that cross: the prism turns over", [] {
    return stress::plain_patch(
        {tilted(75, dvec3(1, 0.3, 0)), tilted(75, dvec3(-1, 0.3, 0)), tilted(75, dvec3(0, -1, 0))});
  }));
  cases.push_back(shape("almost-flat", "curvatures that go to 0 from both sides", almost_flat));
  cases.push_back(
      shape("missed-sphere", "lines along the shell that pass by a vertex's small sphere", [] {
        return stress::patch({dvec3(-1, 0, 0), dvec3(1, 0, 0), dvec3(0.9, 0.5, 0)},
                             {tilted(80, dvec3(-1, 0.5, 0)), tilted(70, dvec3(0.2, -1, 0)),
                              tilted(60, dvec3(-1, 1, 0))});
      }));
  cases.push_back(shape("next-to-a-vertex", "where the angle at the vertex is 0 over 0",
                        [] { return stress::sphere(); }));
  cases.back().rays = rays_next_to_vertices;
}

void add_neighbours(std::vector<RayCase>& cases) {
  cases.push_back(shape("hard-edges",
                        "faces that do not share normals: the curved faces part at the edges",
                        pillow_cube));
  cases.back().surfaces = {SURFACE_FLAT, SURFACE_PHONG, SURFACE_SPHERE};
  cases.push_back(shape("non-manifold-edge", "three patches on one edge", three_leaves));
  cases.push_back(shape("open-border", "beside a border, within and without",
                        [] { return stress::leaning_patch(30.0); }));
  cases.back().rays = rays_next_to_border;
  cases.push_back(
      shape("mixed-winding", "every other face is turned over", every_other_face_turned));
  cases.push_back(
      shape("coincident-patches", "the same patch three times, and one across it", coincident));
  for (const double alpha : {0.0, 1.0, 2.0}) {
    cases.push_back(shape(alpha == 0.0   ? "alpha-0"
                          : alpha == 1.0 ? "alpha-1"
                                         : "alpha-2",
                          "Phong Tessellation none, full and beyond",
                          [] { return stress::sphere(); }));
    cases.back().alpha = alpha;
    cases.back().surfaces = {SURFACE_PHONG};
    cases.back().closed = true;
  }
}

}  // namespace

std::vector<RayCase> stress_reclined_cases() {
  return reclined_cases();
}

std::vector<RayCase> stress_shape_cases() {
  std::vector<RayCase> cases;
  add_normals(cases);
  for (RayCase& ray_case : stress_reclined_cases()) cases.push_back(std::move(ray_case));
  add_forms(cases);
  add_neighbours(cases);
  return cases;
}

}  // namespace trisect
