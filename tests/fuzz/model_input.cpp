#include <array>
#include <string>

#include "app/bake/subpatch_bounds.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "tests/fuzz/answers.h"
#include "tests/support/finite_scene.h"

namespace trisect::fuzz {
namespace {

constexpr std::array<const char*, 8> kEndings{".obj", ".gltf", ".glb",    ".ply",
                                              ".stl", ".fbx",  ".obj.gz", ""};

// Bakes the first triangles of a mesh: all of them would take too long.
void bake_some(Mesh mesh, const SurfaceChoice& choice) {
  const std::size_t most = choice.surface == SURFACE_SPHERE ? 1 : 3;
  if (mesh.triangles.size() > most) mesh.triangles.resize(most);
  if (mesh.colors.size() > most) mesh.colors.resize(most);
  const std::string found = test::first_not_finite(bake_with_subpatches(mesh, choice));
  expect(found.empty(), "not finite in the baked scene: " + found);
}

MeshOptions mesh_options(unsigned which) {
  MeshOptions options;
  if (which == 1) options.crease_degrees = 40.0;
  if (which == 2) options.weld = 0.01;
  if (which == 3) options.repair = true;
  return options;
}

}  // namespace

void model_input(Bytes input) {
  Numbers numbers(input);
  const auto choice = numbers.next<uint8_t>();
  if (numbers.has_ended()) return;
  const std::filesystem::path path =
      write_input(std::string("model") + kEndings[choice % 8], input.subspan(1));
  expect_answer([&] {
    const BuiltMesh built =
        build_mesh(read_model(path), path.string(), mesh_options(choice / 8 % 4));
    const uint surface = choice < 128 ? SURFACE_PHONG : SURFACE_SPHERE;
    bake_some(built.mesh, {surface, 0.65, SHELL_NORMAL});
  });
}

}  // namespace trisect::fuzz
