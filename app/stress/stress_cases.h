// The catalogue of hard cases that every solver is measured on: generated scenes with rays, and
// images and files with a known answer.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "app/bake/bake.h"
#include "app/buffers/kernel_choice.h"
#include "app/frame/frame.h"
#include "app/mesh/mesh.h"
#include "app/surface/shared.h"

namespace trisect {

// Who casts rays and renders frames: a Vulkan device, or the kernel as C++.
struct StressBackend {
  std::string device;
  std::string driver;
  std::function<std::vector<CastHit>(const BakedScene&, const TraceParams&, uint solver,
                                     std::span<const CastRay>)>
      cast;
  std::function<Frame(const BakedScene&, const TraceParams&, const KernelChoice&)> render;
};

enum class StressKind { shape, ray, scale, image, data };

// A scene and its rays; what they meet is the oracle's to say.
struct RayCase {
  std::string name;
  std::string what;  // for the JSON: what is hard about it
  StressKind kind = StressKind::shape;
  std::function<Mesh()> mesh;
  // Rays relative to the scene's origin, from a generator that is seeded the same for every row.
  std::function<std::vector<CastRay>(const BakedScene&, std::mt19937_64&)> rays;
  std::vector<uint> surfaces{SURFACE_PHONG, SURFACE_SPHERE};
  double alpha = 0.65;
  uint32_t rank = 10;
  // Of a surface without border whose faces turn outward, met from outside: a ray that first meets
  // a back comes through a crack.
  bool closed = false;
  // The oracle takes up to a second for a ray that grazes a patch: so many are drawn from all.
  std::size_t most_rays = 120;
};

// Counts of what went otherwise than it should, as analysis says.
struct CheckedOutcome {
  std::size_t rays = 0;  // or pixels, or files
  std::size_t undecidable = 0;
  std::size_t wrong = 0;
  std::size_t missed = 0;
  std::size_t nans = 0;
  std::vector<double> errors;  // across the surface, over the scene's radius
  double evaluations = 0.0;    // all of them
  std::string note;
};

// A case that is no list of rays: an image, a file. Robust solver, normal shell, phong.
struct CheckedCase {
  std::string name;
  std::string what;
  StressKind kind = StressKind::image;
  std::function<CheckedOutcome(const StressBackend&)> run;
};

const char* kind_name(StressKind kind);

std::vector<RayCase> stress_shape_cases();
std::vector<RayCase> stress_ray_cases();
std::vector<RayCase> stress_scale_cases();
// Shapes, rays, scales.
std::vector<RayCase> stress_ray_catalogue();
std::vector<CheckedCase> stress_checked_cases();

}  // namespace trisect
