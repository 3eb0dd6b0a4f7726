// The way through a list of parts, which candidate_count and candidate_at tell: each whose ball the ray meets. Of a divided patch
// the parts stand in a tree, depth first.

bool no_candidates_left(PixelRay ray, uint item) { return item >= candidate_count(ray.tile); }

uint next_item(uint item) { return item + 1u; }

// The next part to be met, at walk.item; NO_TRIANGLE if the list, or the steps, ended before.
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
