#include "app/opengl/shader_head.h"

#include <fmt/format.h>

#include "app/bake/subpatch_bounds.h"

namespace trisect::opengl {

std::string shader_head(const BakedScene& scene, const KernelChoice& choice, bool shadows) {
  std::string head = "#version 430 core\n";
  const auto define = [&](const char* name, uint value) {
    head += fmt::format("#define VALUE_{} {}u\n", name, value);
  };
  define("SURFACE", scene.choice.surface);
  define("SHELL", scene.choice.shell);
  define("SOLVER", choice.solver);
  define("AOVS", choice.writes_aovs() ? 1 : 0);
  define("COUNTS", choice.counts ? 1 : 0);
  define("DIVIDED", has_divided_patches(scene) ? 1 : 0);
  define("NONSMOOTH", has_nonsmooth(scene) ? 1 : 0);
  define("SHADOWS", shadows ? 1 : 0);
  return head;
}

}  // namespace trisect::opengl
