#version 450
// Projects every subpatch for the frame's camera.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = SUBPATCH_GROUP_SIZE) in;

#include "frame_buffers.glsl"
layout(constant_id = CONSTANT_BALLS) const bool BALLS = false;
layout(std430, binding = BINDING_PROJECTED) writeonly restrict buffer ProjectedBlock { ProjectedSubpatch projected[]; };

#include "rays.glsl"
#include "every_candidate.glsl"
#include "trace.glsl"
#include "project_subpatch.glsl"

void main() {
  uint subpatch = gl_GlobalInvocationID.x;
  if (subpatch >= params.subpatch_count) return;
  precise ProjectedSubpatch projection = project_subpatch(subpatch);
  if (BALLS) bound_by_ball(subpatches[subpatch].ball, projection);
  projected[subpatch] = projection;
}
