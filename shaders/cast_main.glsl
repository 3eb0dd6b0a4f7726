// The main function of kernels that cast rays from a buffer: new rays in the first pass, paused rays after it.

void main() {
  uint index = gl_GlobalInvocationID.x;
  Traversal traversal = begin_traversal(int(state.now.steps));
  if (state.now.pass == 0u) {
    index += push.first;
    if (index >= push.end) return;
  } else {
    if (index >= state.now.resumed) return;
    uint place = state.now.from + index;
    traversal = resumed_traversal(place, traversal.steps);
    index = paused[place].ray;
  }
  PixelRay ray = ray_of_cast(rays[index]);
  resume(ray, state.now.pass, traversal);
  if (is_finished(ray, traversal)) {
    hits[index] = cast_result(ray, traversal);
  } else {
    enqueue(index, traversal);
  }
}
