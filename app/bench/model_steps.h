// The steps before models are measured, with lines that show their progress.
#pragma once

#include <string>

#include "app/bake/bake.h"
#include "app/mesh/mesh.h"

namespace trisect::bench {

// Throws InputError, naming the file.
Mesh read_mesh(const std::string& file);

// With its subpatches. model: for messages. Throws InputError, Interrupted.
BakedScene baked(const std::string& model, const Mesh& mesh, const SurfaceChoice& choice);

void add_tree(BakedScene& scene);

}  // namespace trisect::bench
