// Where in the image a part can be, asked of what a frame's camera sees of it.

// Around an image position, in pixels: more than the roundings of one.
const real PIXEL_SLACK = real(0.02);

// Whether a rectangle of the image, given by its middle and half its size, may see the part.
bool overlaps_rect(ProjectedSubpatch view, vec2 middle, vec2 half_size) {
  bool in_box = view.box.x <= middle.x + half_size.x && view.box.z >= middle.x - half_size.x &&
                view.box.y <= middle.y + half_size.y && view.box.w >= middle.y - half_size.y;
  vec3 nearest = vec3(view.lines_x) * middle.x + vec3(view.lines_y) * middle.y -
                 (abs(vec3(view.lines_x)) * half_size.x + abs(vec3(view.lines_y)) * half_size.y);
  return in_box && nearest.x <= view.lines_at.x && nearest.y <= view.lines_at.y && nearest.z <= view.lines_at.z;
}
