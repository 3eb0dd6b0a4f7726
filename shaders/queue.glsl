// Rays that pause, of a kernel with a push constant block `push`.

layout(std430, binding = BINDING_QUEUE) restrict buffer QueueBlock { PausedRay paused[]; };
layout(std430, binding = BINDING_QUEUED) restrict buffer QueuedBlock { uint queued; };

// Which ray this invocation goes on with, from the second pass on; its walk.
uint resumed_ray(uint invocation, OUT(Walk) walk) {
  PausedRay ray = paused[push.queue.from + invocation];
  walk.hit.z = ray.hit.w;
  walk.hit.weights = vec3(ray.hit);
  walk.hit.triangle = ray.triangle;
  walk.counts.evaluations = ray.evaluations;
  walk.counts.candidates = ray.candidates;
  walk.item = ray.item;
  walk.path = ray.path;
  walk.steps = int(push.queue.steps);
  return ray.ray;
}

void pause(uint ray, Walk walk) {
  uint place = push.queue.to + atomicAdd(queued, 1u);
  paused[place].hit = vec4(walk.hit.weights, walk.hit.z);
  paused[place].triangle = walk.hit.triangle;
  paused[place].ray = ray;
  paused[place].item = walk.item;
  paused[place].path = walk.path;
  paused[place].evaluations = walk.counts.evaluations;
  paused[place].candidates = walk.counts.candidates;
}
