// shaders/shared.h for C++: the buffer layouts in single precision, as they lie in device memory.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

namespace trisect {

using glm::uint;
using glm::uvec2;
using glm::vec3;
using glm::vec4;

// The lines below see these names only.
#include "shaders/shared.h"

static_assert(sizeof(Triangle) == 192);
static_assert(offsetof(Triangle, Position) == 0);
static_assert(offsetof(Triangle, Normal) == 48);
static_assert(offsetof(Triangle, TriNormal) == 96);
static_assert(offsetof(Triangle, NormDot) == 112);
static_assert(offsetof(Triangle, Domain) == 128);
static_assert(offsetof(Triangle, VertexData) == 144);
static_assert(sizeof(SubpatchBounds) == 96);
static_assert(offsetof(SubpatchBounds, edge) == 48);
static_assert(offsetof(SubpatchBounds, cone) == 64);
static_assert(offsetof(SubpatchBounds, triangle) == 80);
static_assert(sizeof(TraceParams) == 256);
static_assert(offsetof(TraceParams, grid) == 144);
static_assert(offsetof(TraceParams, width) == 192);
static_assert(offsetof(TraceParams, alpha) == 208);
static_assert(offsetof(TraceParams, shading) == 224);
static_assert(sizeof(CastRay) == 32);
static_assert(sizeof(CastHit) == 32);
static_assert(offsetof(CastHit, triangle) == 12);
static_assert(sizeof(PausedRay) == 80);
static_assert(offsetof(PausedRay, triangle) == 16);
static_assert(offsetof(PausedRay, pending) == 48);
static_assert(sizeof(CastPush) == 8);
static_assert(sizeof(TilePush) == 36);
static_assert(sizeof(ProjectedSubpatch) == 192);
static_assert(offsetof(ProjectedSubpatch, triangle) == 44);
static_assert(offsetof(ProjectedSubpatch, P0) == 64);
static_assert(offsetof(ProjectedSubpatch, sizes) == 176);
static_assert(sizeof(ScreenPush) == 32);
static_assert(offsetof(ScreenPush, shown) == 16);
static_assert(sizeof(PixelAovs) == 48);
static_assert(offsetof(PixelAovs, geometric_u) == 16);
static_assert(offsetof(PixelAovs, v) == 32);
static_assert(offsetof(PixelAovs, triangle) == 36);

}  // namespace trisect
