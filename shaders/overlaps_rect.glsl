// Whether a subpatch can be seen in a rectangle of the image.

// What an image position may be off by, in pixels: more than its roundings.
const real PIXEL_SLACK = real(0.02);

// False if the subpatch is not seen in the rectangle with this middle and half this size, in pixels: it lies beside the
// box, or wholly on the outer side of one of the lines.
bool overlaps_rect(ProjectedSubpatch view, vec2 middle, vec2 half_size) {
  bool in_box = view.box.x <= middle.x + half_size.x && view.box.z >= middle.x - half_size.x &&
                view.box.y <= middle.y + half_size.y && view.box.w >= middle.y - half_size.y;
  vec3 nearest = vec3(view.lines_x) * middle.x + vec3(view.lines_y) * middle.y -
                 (abs(vec3(view.lines_x)) * half_size.x + abs(vec3(view.lines_y)) * half_size.y);
  return in_box && nearest.x <= view.lines_at.x && nearest.y <= view.lines_at.y && nearest.z <= view.lines_at.z;
}
