// Renders an octahedron, given as arrays, as a smooth surface: consumer FILE.png
#include <trisect/trisect.h>

#include <cstdio>
#include <exception>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const std::vector<glm::dvec3> positions{{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                            {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    const std::vector<uint32_t> corners{0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4,
                                        2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    const trisect::BuiltMesh built = trisect::build_mesh(positions, {}, corners);
    const trisect::BakedScene scene = trisect::bake_with_subpatches(built.mesh, {});
    const trisect::TraceParams params =
        make_params(scene, framed_settings(built.mesh, scene, 160, 120));
    const auto result = trace_scene({}, scene, params, {.accel = trisect::Accel::tiles});
    if (!result) return 1;
    save_image(result->frame, argv[1]);
    std::printf("%s: %zu pixels hit\n", result->device.c_str(), result->frame.hits());
    return result->frame.hits() > 4000 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "consumer: %s\n", error.what());
    return 1;
  }
}
