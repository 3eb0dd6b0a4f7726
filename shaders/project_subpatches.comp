#version 450
// Writes what the frame's camera sees of every part.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = PARTS_SIZE) in;

#include "frame_buffers.glsl"
layout(constant_id = CONSTANT_BALLS) const bool BALLS = false;
layout(std430, binding = BINDING_VIEW_PARTS) writeonly restrict buffer ViewPartsBlock { ViewPart view_parts[]; };

#include "rays.glsl"
#include "every_candidate.glsl"
#include "trace.glsl"
#include "project_subpatch.glsl"

void main() {
  uint part = gl_GlobalInvocationID.x;
  if (part >= params.cage_count) return;
  precise ViewPart view = seen_part(part);
  if (BALLS) bound_by_ball(cages[part].ball, view);
  view_parts[part] = view;
}
