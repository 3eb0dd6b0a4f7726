// The kernel as C++ in single precision: the shaders' source text, compiled as the member functions
// of an object whose data members stand for the kernel's buffers and specialisation constants.
// Their names are therefore those of the GLSL.
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
// Only kernels that go by tiles use the parameter `tile`.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include "shaders/every_candidate.glsl"
#pragma GCC diagnostic pop
// Needs the candidates, above.
#include "shaders/trace.glsl"
// Needs the traversal, above.
#include "shaders/shadow.glsl"
// Needs the camera's frame of rays.glsl.
#include "shaders/project_subpatch.glsl"
// Needs project_subpatch.glsl.
#include "shaders/overlaps_rect.glsl"
};

#undef real
#undef EXACT
#undef OUT
#undef INOUT

// The kernel that a back end makes of the same scene and choice, for camera rays: SHADOWS is false.
// It keeps references to `scene` and `params`, which must outlive it. Its functions are not const,
// because GLSL has no such thing: each thread needs a copy of its own.
Kernel kernel_of(const BakedScene& scene, const TraceParams& params, const KernelChoice& choice);

}  // namespace trisect::in_float
