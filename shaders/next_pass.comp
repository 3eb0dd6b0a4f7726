#version 450
// Makes the rays that have paused those of the next pass.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"

layout(local_size_x = 1) in;

layout(std430, binding = BINDING_QUEUED) restrict buffer QueuedBlock { QueueState state; };

void main() {
  if (state.is_held != 0u) return;
  uint filled = state.now.to;
  ++state.now.pass;
  state.now.resumed = state.queued;
  state.now.to = state.now.from;
  state.now.from = filled;
  state.all_queued += state.queued;
  state.queued = 0u;
  state.groups_x = (state.now.resumed + uint(TILE_SIZE * TILE_SIZE) - 1u) / uint(TILE_SIZE * TILE_SIZE);
}
