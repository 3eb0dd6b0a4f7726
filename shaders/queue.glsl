// Rays that pause.

layout(std430, binding = BINDING_QUEUE) restrict buffer QueueBlock { PausedRay paused[]; };
layout(std430, binding = BINDING_QUEUED) restrict buffer QueuedBlock { QueueState state; };

// The walk that paused at a place of the queue.
Walk resumed_walk(uint place, int steps) {
  PausedRay ray = paused[place];
  Walk walk;
  walk.hit.z = ray.hit.w;
  walk.hit.weights = vec3(ray.hit);
  walk.hit.triangle = ray.triangle;
  walk.hit.part = ray.part;
  walk.counts.evaluations = ray.evaluations;
  walk.counts.candidates = ray.candidates;
  walk.counts.bytes = 0u;
  walk.item = ray.item;
  walk.path = ray.path;
  walk.steps = steps;
  return walk;
}

void pause(uint place, uint ray, Walk walk) {
  paused[place].hit = vec4(walk.hit.weights, walk.hit.z);
  paused[place].triangle = walk.hit.triangle;
  paused[place].part = walk.hit.part;
  paused[place].ray = ray;
  paused[place].item = walk.item;
  paused[place].path = walk.path;
  paused[place].evaluations = walk.counts.evaluations;
  paused[place].candidates = walk.counts.candidates;
}

// At the next place of the half that is filled.
void enqueue(uint ray, Walk walk) { pause(push.queue.to + atomicAdd(state.queued, 1u), ray, walk); }

// Adds what an invocation has read to what all of them have.
void count_bytes(Walk walk) {
  if (!COUNTS) return;
  uint before = atomicAdd(state.bytes_low, walk.counts.bytes);
  if (before + walk.counts.bytes < before) atomicAdd(state.bytes_high, 1u);
}
