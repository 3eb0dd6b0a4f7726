#include "app/bench/model_steps.h"

#include "app/bake/bvh.h"
#include "app/cli/load_scene.h"
#include "app/cli/named.h"
#include "app/cli/progress_line.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"

namespace trisect::bench {

Mesh read_mesh(const std::string& file) {
  const BusyLine line("reading " + file);
  return build_mesh(read_model(file), file).mesh;
}

BakedScene baked(const std::string& model, const Mesh& mesh, const SurfaceChoice& choice) {
  return named(model, [&] { return bake_showing_progress(mesh, choice); });
}

void add_tree(BakedScene& scene) {
  const BusyLine line("building the tree");
  scene.bvh = build_bvh(scene);
}

}  // namespace trisect::bench
