// The way through a list of parts, which part_count and part_at tell: each whose ball the ray meets. Of a divided patch
// the parts stand in a tree, depth first.

bool no_parts_left(PixelRay ray, uint item) { return item >= part_count(ray.tile); }

uint item_after(uint item) { return item + 1u; }

// The next part to be met, at walk.item; NO_TRIANGLE if the list, or the steps, ended before.
uint find_part(PixelRay ray, INOUT(Walk) walk) {
  uint count = part_count(ray.tile);
  uint part = 0u;
  bool met = false;
  while (walk.item < count && walk.steps > 0 && !met) {
    --walk.steps;
    part = part_at(ray.tile, walk.item);
    if (COUNTS) walk.counts.bytes += BALL_BYTES;
    if (is_beside(ray, cages[part].ball, walk.hit.z)) {
      walk.item += GROUPS ? cages[part].skip + 1u : 1u;
      walk.path = WHOLE;
    } else {
      met = !GROUPS || cages[part].skip == 0u;
      if (!met) ++walk.item;
    }
  }
  return met ? part : NO_TRIANGLE;
}
