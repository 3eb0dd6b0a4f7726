#version 450
// Begins a part of a frame's rays: sets the queue's first pass and the workgroups of the dispatch that follows. If rays of an
// earlier part are left, or the tiles' lists do not fit, that and all that follow in the submit are of no workgroups.
#extension GL_GOOGLE_include_directive : require
#include "language.h"
#include "shared.h"

layout(local_size_x = 1) in;

layout(push_constant) uniform PushBlock { TilePush push; };
layout(std430, binding = BINDING_QUEUED) restrict buffer QueuedBlock { QueueState state; };
layout(std430, binding = BINDING_TILE_TOTALS) readonly restrict buffer TileTotalsBlock { TileTotals totals; };
layout(std430, binding = BINDING_TILE_SUBPATCHES) readonly restrict buffer TileSubpatchesBlock {
  uint tile_subpatches[];
};

void main() {
  state.groups_x = 0u;
  state.groups_y = 1u;
  state.groups_z = 1u;
  bool lists_fit = push.must_fit == 0u || totals.entries <= uint(tile_subpatches.length());
  if (state.now.resumed > 0u || !lists_fit) state.is_held = 1u;
  if (state.is_held != 0u) return;
  ++state.begun;
  state.now.pass = 0u;
  state.now.steps = push.steps;
  state.now.from = 0u;
  state.now.to = push.half_queue;
  state.queued = 0u;
  uint groups = push.groups;
  if (push.listed != 0u) groups = min(groups, max(totals.tiles, push.first_group) - push.first_group);
  state.groups_x = groups;
}
