#include "tests/support/garbage.h"

#include <bit>
#include <limits>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/stress/stress_scenes.h"
#include "app/surface/surface_float.h"

namespace trisect::test {
namespace {

void spoil(std::mt19937& random, float& number) {
  if (random() % 3 > 0) number = garbage_number(random);
}

void spoil(std::mt19937& random, vec4& numbers) {
  for (int i = 0; i < 4; ++i) spoil(random, numbers[i]);
}

void spoil_three(std::mt19937& random, vec4& numbers) {
  for (int i = 0; i < 3; ++i) spoil(random, numbers[i]);
}

}  // namespace

const char* garbage_name(Garbage garbage) {
  switch (garbage) {
    case Garbage::positions:
      return "positions";
    case Garbage::normals:
      return "normals";
    case Garbage::other_of_triangle:
      return "what follows from these";
    case Garbage::bounds:
      return "bounds of subpatches";
    case Garbage::errors:
      return "errors of bounds";
    case Garbage::tree:
      return "tree";
    case Garbage::params:
      return "parameters";
    case Garbage::rays:
      return "rays";
    default:
      return "all";
  }
}

BakedScene two_subpatches(const SurfaceChoice& choice) {
  const Mesh mesh = stress::joined(stress::leaning_patch(30.0), stress::leaning_patch(20.0),
                                   glm::dvec3(0.3, 0.2, -0.5));
  BakedScene scene = bake_with_subpatches(mesh, choice);
  std::erase_if(scene.subpatches, [](const SubpatchBounds& bounds) { return bounds.skip > 0; });
  scene.subpatches.erase(scene.subpatches.begin() + 1, scene.subpatches.end() - 1);
  scene.bvh = build_bvh(scene);
  return scene;
}

float garbage_number(std::mt19937& random) {
  using Limits = std::numeric_limits<float>;
  const auto sign = random() % 2 == 0 ? 1.0F : -1.0F;
  switch (random() % 10) {
    case 0:
      return sign * Limits::quiet_NaN();
    case 1:
      return sign * Limits::infinity();
    case 2:
      return sign * Limits::max();
    case 3:
      return sign * Limits::denorm_min();
    case 4:
      return sign * 1e-30F;
    case 5:
      return sign * 1e15F;
    case 6:
      return sign * 0.0F;
    case 7:
      return sign;
    default:
      return std::bit_cast<float>(static_cast<uint32_t>(random()));
  }
}

void spoil(Garbage garbage, std::mt19937& random, BakedScene& scene) {
  const auto is = [&](Garbage part) { return garbage == part || garbage == Garbage::all; };
  for (Triangle& tri : scene.triangles) {
    for (int i = 0; i < 3; ++i) {
      if (is(Garbage::positions)) spoil(random, tri.Position[i]);
      if (is(Garbage::normals)) spoil(random, tri.Normal[i]);
      if (is(Garbage::other_of_triangle)) spoil(random, tri.VertexData[i]);
    }
    if (!is(Garbage::other_of_triangle)) continue;
    spoil(random, tri.TriNormal);
    spoil(random, tri.NormDot);
    spoil(random, tri.Domain);
  }
  for (SubpatchBounds& bounds : scene.subpatches) {
    if (is(Garbage::bounds)) {
      spoil(random, bounds.ball);
      spoil(random, bounds.sub_triangle);
      spoil_three(random, bounds.corner);
      spoil_three(random, bounds.edge);
      spoil(random, bounds.cone);
    }
    if (is(Garbage::errors)) {
      spoil(random, bounds.corner.w);
      spoil(random, bounds.edge.w);
      spoil(random, bounds.gradient_lipschitz);
    }
  }
  if (!is(Garbage::tree)) return;
  for (BvhNode& node : scene.bvh) {
    for (float* number : {&node.origin_x, &node.origin_y, &node.origin_z, &node.step_x,
                          &node.step_y, &node.step_z}) {
      spoil(random, *number);
    }
  }
}

void spoil(Garbage garbage, std::mt19937& random, TraceParams& params) {
  if (garbage != Garbage::params && garbage != Garbage::all) return;
  for (vec4* numbers :
       {&params.eye, &params.ray_corner, &params.ray_dx, &params.ray_dy, &params.anchor,
        &params.frame_x, &params.frame_y, &params.frame_z, &params.light, &params.grid}) {
    spoil(random, *numbers);
  }
  spoil(random, params.alpha);
  spoil(random, params.resolution);
  spoil(random, params.min_delta);
}

void spoil(Garbage garbage, std::mt19937& random, std::vector<CastRay>& rays) {
  if (garbage != Garbage::rays && garbage != Garbage::all) return;
  for (CastRay& ray : rays) {
    spoil(random, ray.anchor);
    spoil(random, ray.direction);
  }
}

uint64_t most_evaluations(const BakedScene& scene) {
  return uint64_t{in_float::MOST_EVALUATIONS} * scene.subpatches.size();
}

}  // namespace trisect::test
