// Rays that pause.

layout(std430, binding = BINDING_QUEUE) restrict buffer QueueBlock { PausedRay paused[]; };
layout(std430, binding = BINDING_QUEUED) restrict buffer QueuedBlock { uint queued; };

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
void enqueue(uint ray, Walk walk) { pause(push.queue.to + atomicAdd(queued, 1u), ray, walk); }
