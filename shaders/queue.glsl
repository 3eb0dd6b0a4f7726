// Rays that pause.

layout(std430, binding = BINDING_QUEUE) restrict buffer QueueBlock { PausedRay paused[]; };
layout(std430, binding = BINDING_QUEUED) restrict buffer QueuedBlock { QueueState state; };

// The walk that paused at a place of the queue.
Traversal resumed_traversal(uint place, int steps) {
  PausedRay ray = paused[place];
  Traversal traversal;
  traversal.hit.z = ray.hit.w;
  traversal.hit.weights = vec3(ray.hit);
  traversal.hit.triangle = ray.triangle;
  traversal.hit.subpatch = ray.subpatch;
  traversal.counts.evaluations = ray.evaluations;
  traversal.counts.candidates = ray.candidates;
  traversal.counts.bytes = 0u;
  traversal.item = ray.item;
  traversal.path = ray.path;
  traversal.steps = steps;
  return traversal;
}

void pause(uint place, uint ray, Traversal traversal) {
  paused[place].hit = vec4(traversal.hit.weights, traversal.hit.z);
  paused[place].triangle = traversal.hit.triangle;
  paused[place].subpatch = traversal.hit.subpatch;
  paused[place].ray = ray;
  paused[place].item = traversal.item;
  paused[place].path = traversal.path;
  paused[place].evaluations = traversal.counts.evaluations;
  paused[place].candidates = traversal.counts.candidates;
}

// At the next place of the half that is filled.
void enqueue(uint ray, Traversal traversal) { pause(push.queue.to + atomicAdd(state.queued, 1u), ray, traversal); }

// Adds what an invocation has read to what all of them have.
void count_bytes(Traversal traversal) {
  if (!COUNTS) return;
  uint before = atomicAdd(state.bytes_low, traversal.counts.bytes);
  if (before + traversal.counts.bytes < before) atomicAdd(state.bytes_high, 1u);
}
