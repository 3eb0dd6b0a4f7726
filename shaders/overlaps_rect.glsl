// Culling by the image: where the projection of a subpatch can be.

// Margin around an image position, in pixels: more than its rounding errors.
const real PIXEL_SLACK = real(0.02);

// Whether the projection may overlap a rectangle of the image, given by its middle and half its size in pixels. False is
// certain.
bool overlaps_rect(ProjectedSubpatch projection, vec2 middle, vec2 half_size) {
  bool in_box = projection.box.x <= middle.x + half_size.x && projection.box.z >= middle.x - half_size.x &&
                projection.box.y <= middle.y + half_size.y && projection.box.w >= middle.y - half_size.y;
  vec3 nearest = vec3(projection.lines_x) * middle.x + projection.lines_y * middle.y -
                 (abs(vec3(projection.lines_x)) * half_size.x + abs(projection.lines_y) * half_size.y);
  return in_box && nearest.x <= projection.lines_at.x && nearest.y <= projection.lines_at.y &&
         nearest.z <= projection.lines_at.z;
}
