// The catalogue of hard cases that every solver is measured on: generated scenes with lists of
// rays, and images and files with a known answer.
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

// What casts rays and renders frames: a Vulkan device, or the kernel compiled as C++
// (stress_backend.h). Its functions are to be called from one thread at a time.
struct StressBackend {
  std::string device;
  std::string driver;
  // One hit for each ray, in their order.
  std::function<std::vector<CastHit>(const BakedScene&, const TraceParams&, uint solver,
                                     std::span<const CastRay>)>
      cast;
  std::function<Frame(const BakedScene&, const TraceParams&, const KernelChoice&)> render;
};

enum class StressKind { shape, ray, scale, image, data };

// The share of a case's rays that the oracle may leave undecided, unless the case sets another: a
// few rays graze the surface or pass a border by chance.
constexpr double kMostUndecidableRays = 0.1;

// A scene and its rays; the oracle tells what they hit.
struct RayCase {
  std::string name;
  std::string what;  // what is hard about it, for the JSON
  StressKind kind = StressKind::shape;
  std::function<Mesh()> mesh;
  // Rays relative to the scene's origin. The generator is seeded the same for every row.
  std::function<std::vector<CastRay>(const BakedScene&, std::mt19937_64&)> rays;
  std::vector<uint> surfaces{SURFACE_PHONG, SURFACE_SPHERE};
  double alpha = 0.65;
  uint32_t rank = 10;
  // The surface has no border, its faces turn outward, and all rays begin outside. A ray that first
  // meets a back side came in through a crack between patches.
  bool closed = false;
  // The oracle takes up to a second for a ray that grazes a patch: only so many rays are used,
  // drawn at random from all.
  std::size_t most_rays = 120;
  // A row with a larger share of undecidable rays than this fails, for it would test too little.
  double most_undecidable = kMostUndecidableRays;
};

// How the hits of one row compare with the right answers.
struct CheckedOutcome {
  std::size_t rays = 0;  // or pixels, or files
  std::size_t undecidable = 0;
  std::size_t wrong = 0;
  std::size_t missed = 0;
  std::size_t nans = 0;
  std::vector<double> errors;  // distances off the surface of correct hits, over the scene's radius
  double evaluations = 0.0;    // of a field or a surface, the sum over all rays
  std::string note;            // for a reader of the table
};

// A case that is not a list of rays: an image, a file. It runs with the robust solver in the normal
// shell of Phong Tessellation.
struct CheckedCase {
  std::string name;
  std::string what;  // what is hard about it, for the JSON
  StressKind kind = StressKind::image;
  std::function<CheckedOutcome(const StressBackend&)> run;
};

const char* kind_name(StressKind kind);

std::vector<RayCase> stress_shape_cases();
// Those of the shapes that have normals in their face's plane or beyond it.
std::vector<RayCase> stress_reclined_cases();
std::vector<RayCase> stress_ray_cases();
std::vector<RayCase> stress_scale_cases();
// All of these: shapes, rays, scales.
std::vector<RayCase> stress_ray_catalogue();
std::vector<CheckedCase> stress_checked_cases();

}  // namespace trisect
