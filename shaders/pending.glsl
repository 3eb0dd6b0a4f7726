// What Newton's method leaves undecided for a ray, on the way from the kernel that tries it to trace_pending.comp.

struct Pending {
  uvec4 latest;  // the indices of the last four subpatches, the last one first
  uvec4 older;   // and of the four before
  uint count;    // TOO_MANY_PENDING and more: the ray has to go through all candidates again
};
const uint TOO_MANY_PENDING = MOST_PENDING + 1u;

Pending nothing_pending() {
  Pending pending;
  pending.latest = uvec4(NO_TRIANGLE);
  pending.older = uvec4(NO_TRIANGLE);
  pending.count = 0u;
  return pending;
}

// Puts a subpatch ahead of the others if it is undecided. Without an array, which drivers would index by branches.
void add_pending(uint subpatch, bool undecided, inout Pending pending) {
  pending.older = undecided ? uvec4(pending.latest.w, pending.older.xyz) : pending.older;
  pending.latest = undecided ? uvec4(subpatch, pending.latest.xyz) : pending.latest;
  pending.count += undecided ? 1u : 0u;
}

// enqueue() with what is pending. ray: as in PausedRay.
void enqueue_pending(uint ray, Traversal traversal, Pending pending) {
  uint place = next_place();
  pause(place, ray, traversal);
  if (pending.count >= TOO_MANY_PENDING) return;
  paused[place].pending_count = pending.count;
  paused[place].pending[0] = pending.latest.x;
  paused[place].pending[1] = pending.latest.y;
  paused[place].pending[2] = pending.latest.z;
  paused[place].pending[3] = pending.latest.w;
  paused[place].pending[4] = pending.older.x;
  paused[place].pending[5] = pending.older.y;
  paused[place].pending[6] = pending.older.z;
  paused[place].pending[7] = pending.older.w;
}
