// The kernel as C++ in single precision: the shaders' source text, compiled a second time, as the
// member functions of an object that holds what the kernel finds in its buffers and constants.
#pragma once

#include <glm/glm.hpp>

#include "app/bake/bake.h"
#include "app/buffers/kernel_choice.h"
#include "app/surface/shared.h"
#include "app/surface/surface_float.h"

namespace trisect::in_float {

#define real float
#define EXACT
#define OUT(T) T&
#define INOUT(T) T&

struct Kernel {
  const TraceParams& params;
  const Triangle* triangles;
  const SubpatchBounds* subpatches;
  uint SURFACE;
  uint SHELL;
  uint SOLVER;
  bool AOVS;
  bool COUNTS;
  bool DIVIDED;
  bool MAY_BE_NONSMOOTH;
  bool SHADOWS;

#include "shaders/rays.glsl"
#include "shaders/shading.glsl"
// Here a ray's tile means nothing.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include "shaders/every_candidate.glsl"
#pragma GCC diagnostic pop
// The parts, above, are what a ray goes through.
#include "shaders/trace.glsl"
// What has been met casts shadows.
#include "shaders/shadow.glsl"
// What a camera sees needs its frame, above.
#include "shaders/project_subpatch.glsl"
// The box and the lines of that.
#include "shaders/overlaps_rect.glsl"
};

#undef real
#undef EXACT
#undef OUT
#undef INOUT

// The kernel that a back end makes of the same scene and choice, for what a camera sees: SHADOWS is
// false. Keeps references to both of the first two. Each thread needs a copy: GLSL knows no const
// functions.
Kernel kernel_of(const BakedScene& scene, const TraceParams& params, const KernelChoice& choice);

}  // namespace trisect::in_float
