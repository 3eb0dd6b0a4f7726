// The queue of rays that paused: their traversals are stored in it and resumed by the next pass. It has two halves, of which
// one is read while the other is filled (app/dispatch/ray_queue.h).

layout(std430, binding = BINDING_QUEUE) restrict buffer QueueBlock { PausedRay paused[]; };
layout(std430, binding = BINDING_QUEUED) restrict buffer QueuedBlock { QueueState state; };

// The traversal that is stored at a place of the queue, with so many steps until it pauses again.
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

// Stores a traversal at a place of the queue. ray: as in PausedRay.
void pause(uint place, uint ray, Traversal traversal) {
  paused[place].hit = vec4(traversal.hit.weights, traversal.hit.z);
  paused[place].triangle = traversal.hit.triangle;
  paused[place].subpatch = traversal.hit.subpatch;
  paused[place].ray = ray;
  paused[place].item = traversal.item;
  paused[place].path = traversal.path;
  paused[place].evaluations = traversal.counts.evaluations;
  paused[place].candidates = traversal.counts.candidates;
  paused[place].pending_count = 0u;
}

// The next place of the half that is being filled.
uint next_place() { return state.now.to + atomicAdd(state.queued, 1u); }

// Stores a traversal there.
void enqueue(uint ray, Traversal traversal) { pause(next_place(), ray, traversal); }

// Adds the bytes that this invocation has read to the total, a 64-bit number in two words.
void count_bytes(Traversal traversal) {
  if (!COUNTS) return;
  uint before = atomicAdd(state.bytes_low, traversal.counts.bytes);
  if (before + traversal.counts.bytes < before) atomicAdd(state.bytes_high, 1u);
}
