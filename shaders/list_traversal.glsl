// Traversal of a list of subpatches, given by candidate_count and candidate_at. The subpatches of a divided patch are a
// tree in depth-first order: each inner entry's ball contains those of its descendants, and `skip` is their number.

bool no_candidates_left(PixelRay ray, uint item) { return item >= candidate_count(ray.tile); }

uint next_item(uint item) { return item + 1u; }

// The next candidate, which is that of traversal.item on return; NO_TRIANGLE if there is none, or if no steps are left.
uint find_candidate(PixelRay ray, INOUT(Traversal) traversal) {
  uint count = candidate_count(ray.tile);
  uint subpatch = 0u;
  bool met = false;
  while (traversal.item < count && traversal.steps > 0 && !met) {
    --traversal.steps;
    subpatch = candidate_at(ray.tile, traversal.item);
    if (COUNTS) traversal.counts.bytes += BALL_BYTES;
    if (misses_ball(ray, subpatches[subpatch].ball, traversal.hit.z)) {
      traversal.item += DIVIDED ? subpatches[subpatch].skip + 1u : 1u;
      traversal.path = WHOLE;
    } else {
      met = !DIVIDED || subpatches[subpatch].skip == 0u;
      if (!met) ++traversal.item;
    }
  }
  return met ? subpatch : NO_TRIANGLE;
}
