// A kernel that casts rays from a buffer: new ones, or what is left of paused ones.

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
