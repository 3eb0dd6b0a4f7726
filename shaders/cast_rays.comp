#version 450
// Rays from a buffer, whatever they are aimed at, against every triangle: for tests of the solvers.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"
#include "solvers.glsl"

layout(local_size_x = CAST_SIZE) in;

layout(constant_id = CONSTANT_SURFACE) const uint SURFACE = SURFACE_PHONG;
layout(constant_id = CONSTANT_SHELL) const uint SHELL = SHELL_NORMAL;
layout(constant_id = CONSTANT_GROUPS) const bool GROUPS = false;
layout(constant_id = CONSTANT_SOLVER) const uint SOLVER = SOLVER_ROBUST;
const bool AOVS = false;
const bool COUNTS = true;

layout(std140, binding = BINDING_PARAMS) uniform ParamsBlock { TraceParams params; };
layout(std430, binding = BINDING_TRIANGLES) readonly restrict buffer TrianglesBlock {
  Triangle triangles[];
};
layout(std430, binding = BINDING_CAGES) readonly restrict buffer CagesBlock { Cage cages[]; };
layout(std430, binding = BINDING_RAYS) readonly restrict buffer RaysBlock { CastRay rays[]; };
layout(std430, binding = BINDING_HITS) writeonly restrict buffer HitsBlock { CastHit hits[]; };
layout(push_constant) uniform PushBlock { CastPush push; };

#include "every_part.glsl"
#include "trace.glsl"
#include "queue.glsl"

void main() {
  uint index = gl_GlobalInvocationID.x;
  Walk walk = walk_begun(int(push.queue.steps));
  if (push.queue.pass == 0u) {
    index += push.first;
    if (index >= push.end) return;
  } else {
    if (index >= push.queue.resumed) return;
    uint place = push.queue.from + index;
    walk = resumed_walk(place, walk.steps);
    index = paused[place].ray;
  }
  PixelRay ray = ray_cast(rays[index]);
  go_on(ray, push.queue.pass, walk);
  if (is_through(ray, walk)) {
    hits[index] = hit_cast(ray, walk);
  } else {
    enqueue(index, walk);
  }
}
