// The robust solver in single precision where its own roundings decide.
#include <gtest/gtest.h>

#include <cmath>

#include "app/cage.h"
#include "app/kernel_float.h"
#include "app/oracle_tracer.h"
#include "app/trace_settings.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

// A ray that grazes a patch with a vertex at the scene's origin, where the first vertex's roundings
// are nothing: both of its roots lie on a bump of a hundred-thousandth of the model's size.
TEST(Roundings, MeetsTheFirstOfTwoCloseRootsNextToTheOrigin) {
  const Mesh mesh = test::load_asset("saddle");
  for (const uint shell : {SHELL_NORMAL, SHELL_HEIGHT}) {
    const BakedScene scene = bake_with_cages(mesh, {SURFACE_SPHERE, 0.0, shell});
    TraceSettings settings;
    settings.solver = SOLVER_ROBUST;
    settings.camera =
        framing_camera(mesh.positions, scene.origin, 45.0, {0.0, 1.0, 0.0}, 800.0 / 600.0);
    const TraceParams params = make_params(scene, settings);
    in_float::Kernel kernel = in_float::kernel_of(scene, params, {SOLVER_ROBUST, false, false});
    // Its neighbours for company.
    for (uint x = 430; x < 450; ++x) {
      const in_float::Kernel::PixelRay ray = kernel.pixel_ray({x, 286});
      in_float::Walk walk = kernel.walk_begun(1 << 20);
      kernel.go_on(ray, 0, walk);
      ASSERT_TRUE(kernel.is_through(ray, walk));
      const in_float::Hit hit = kernel.met_by(ray, walk);
      const OraclePixelRay asked = oracle_pixel_ray(params, x, 286);
      const OracleAnswer answer = Oracle(scene).first(asked.ray, kMotion * asked.anchor_distance);
      if (!answer.decidable) continue;
      ASSERT_EQ(hit.triangle != NO_TRIANGLE, answer.hit) << x;
      if (!answer.hit) continue;
      // Across the surface some roundings; the second root is 0.013 behind the first.
      const double across = (static_cast<double>(hit.z) - answer.root.t - asked.anchor_distance) *
                            std::abs(glm::dot(answer.root.normal, asked.ray.direction));
      EXPECT_LT(std::abs(across), 2e-6 * scene.radius) << x << " in shell " << shell;
    }
  }
}

}  // namespace
}  // namespace trisect
