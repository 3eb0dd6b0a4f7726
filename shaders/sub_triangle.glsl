// Sub-triangles of a patch (SubTriangle of shape.glsl). They come from the whole triangle by halving and by margins of
// 1/8 and 1/32 of their size, so their members and the weights of their corners are dyadic numbers of few digits: all
// of this but weights_in and centre_of is exact.

// Barycentric weights within the sub-triangle of the point with weights w of the patch.
vec3 weights_in(SubTriangle node, vec3 w) { return (w - node.origin) / node.size; }

// Weights of the patch of the point with weights l within the sub-triangle.
vec3 weights_of(SubTriangle node, vec3 l) { return node.origin + l * node.size; }

vec3 centre_of(SubTriangle node) { return node.origin + vec3(node.size / real(3.0)); }

// From the origin of a sub-triangle to that of its child k, whose size is half_size or, for k = 3, -half_size.
vec3 child_shift(uint k, real half_size) {
  if (k == 3u) return vec3(half_size);
  return vec3(k == 0u ? half_size : real(0.0), k == 1u ? half_size : real(0.0),
              k == 2u ? half_size : real(0.0));
}

// One of the four sub-triangles between the corners and the midpoints of the edges: child k = 0, 1, 2 keeps corner k;
// child 3 is the one in the middle, turned upside down, whose corner i is the midpoint of the edge opposite corner i.
SubTriangle child(SubTriangle node, uint k) {
  real half_size = real(0.5) * node.size;
  SubTriangle quarter;
  quarter.origin = node.origin + child_shift(k, half_size);
  quarter.size = k == 3u ? -half_size : half_size;
  return quarter;
}

// The sub-triangle whose child k this is.
SubTriangle parent(SubTriangle quarter, uint k) {
  real half_size = k == 3u ? -quarter.size : quarter.size;
  SubTriangle node;
  node.origin = quarter.origin - child_shift(k, half_size);
  node.size = real(2.0) * half_size;
  return node;
}

// The sub-triangle with a margin of this part of its size along each side: its weights within go down to -margin. It
// may reach beyond the patch.
SubTriangle enlarged(SubTriangle node, real margin) {
  SubTriangle wide;
  wide.origin = node.origin - vec3(margin * node.size);
  wide.size = (real(1.0) + real(3.0) * margin) * node.size;
  return wide;
}

// As a sub-triangle is searched: neighbours overlap, so that no root is lost on the border between two.
SubTriangle with_overlap(SubTriangle node) { return enlarged(node, real(OVERLAP)); }
