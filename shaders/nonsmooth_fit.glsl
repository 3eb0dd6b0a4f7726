// Bounds of a node of a nonsmooth subpatch of the sphere surface, by the ranges of sigma and its derivatives
// (sphere_range.glsl). A node is a sub-triangle of the quadtree that the robust solver divides a subpatch into.

Corners at_corners(SubTriangle node, vec3 v0, vec3 v1, vec3 v2) {
  Corners at;
  at.a = weigh(weights_of(node, vec3(1.0, 0.0, 0.0)), v0, v1, v2);
  at.b = weigh(weights_of(node, vec3(0.0, 1.0, 0.0)), v0, v1, v2);
  at.c = weigh(weights_of(node, vec3(0.0, 0.0, 1.0)), v0, v1, v2);
  at.error = real(0.0);
  return at;
}

// The derivative of D by the weight i, 1 or 2.
vec3 direction_change(Shape shape, Triangle tri, int i) {
  return corner_direction(shape.shell, tri.Normal[i], tri.NormDot[i]) -
         corner_direction(shape.shell, tri.Normal[0], tri.NormDot.x);
}

// The base triangle, the directions, their squares and the weights over a node.
struct SphereOverSubTriangle {
  Corners T;
  Corners D;
  Range DD;
  vec3 least_weights;
  vec3 largest_weights;
};

SphereOverSubTriangle sphere_node(Shape shape, Triangle tri, SubTriangle node) {
  SphereOverSubTriangle over;
  over.T = at_corners(node, vec3(tri.Position[0]), vec3(tri.Position[1]), vec3(tri.Position[2]));
  over.D = at_corners(node, corner_direction(shape.shell, tri.Normal[0], tri.NormDot.x),
                      corner_direction(shape.shell, tri.Normal[1], tri.NormDot.y),
                      corner_direction(shape.shell, tri.Normal[2], tri.NormDot.z));
  over.DD = square_range(over.D, vec3(tri.TriNormal));
  vec3 end = node.origin + vec3(node.size);
  over.least_weights = min(node.origin, end);
  over.largest_weights = max(node.origin, end);
  return over;
}

// Ranges of sigma and its derivatives along u and v; UNBOUNDED where nothing is known of those.
SphereRange sphere_range(Shape shape, Triangle tri, SphereOverSubTriangle over) {
  vec3 Du = direction_change(shape, tri, 1);
  vec3 Dv = direction_change(shape, tri, 2);
  vec3 Tu = vec3(tri.Position[1]) - vec3(tri.Position[0]);
  vec3 Tv = vec3(tri.Position[2]) - vec3(tri.Position[0]);
  SphereRange sigma;
  sigma.s = point_range(real(0.0));
  sigma.u = point_range(real(0.0));
  sigma.v = point_range(real(0.0));
  for (int i = 0; i < 3; ++i) {
    HeightRange h = height_range(tri, i, over.T, over.D, over.DD);
    add_height(sigma, i, h, between(over.least_weights[i], over.largest_weights[i]), Tu, Tv, Du, Dv);
  }
  sigma.s = range_grown(sigma.s, RANGE_SLACK * range_magnitude(sigma.s));
  // Written so that a NaN bounds nothing.
  bool bounded = over.DD.lo > real(0.0) &&
                 max(range_magnitude(sigma.u), range_magnitude(sigma.v)) < real(1e-10) * UNBOUNDED;
  if (!bounded) {
    sigma.u = unbounded_range();
    sigma.v = unbounded_range();
  }
  return sigma;
}

// Whether a node displaced by sigma comes within `tolerance` of the ray: it lies in the hull of its corners, each displaced
// by the least and by the largest sigma. The hull has six points; a control net with all of them takes the same tests as
// that of a cubic.
bool prism_overlaps_ray(FramedPatch framed, SubTriangle node, Range sigma, real tolerance) {
  Corners T = at_corners(node, framed.P0, framed.P1, framed.P2);
  Corners D = at_corners(node, framed.D0, framed.D1, framed.D2);
  ControlNet net;
  net.b300 = vec2(T.a) + vec2(D.a) * sigma.lo;
  net.b030 = vec2(T.b) + vec2(D.b) * sigma.lo;
  net.b003 = vec2(T.c) + vec2(D.c) * sigma.lo;
  net.b210 = net.b300 + vec2(D.a) * (sigma.hi - sigma.lo);
  net.b120 = net.b030 + vec2(D.b) * (sigma.hi - sigma.lo);
  net.b021 = net.b003 + vec2(D.c) * (sigma.hi - sigma.lo);
  net.b012 = net.b021;
  net.b102 = net.b021;
  net.b201 = net.b021;
  net.b111 = net.b021;
  return hull_overlaps_ray(net, tolerance) && !separated_along(net, vec2(D.a) + vec2(D.b) + vec2(D.c), tolerance);
}

// Whether a node of a nonsmooth subpatch comes within `tolerance` of the ray, as far as sigma's range tells, and if it does
// a quadratic for it: linear, with the middles of the derivatives' ranges for gradient, or constant where those are
// unbounded. Its tangent_error is UNBOUNDED then.
bool ranged_fit(Shape shape, Triangle tri, FramedPatch framed, SubTriangle node, real tolerance, OUT(Fit) fit,
                INOUT(uint) evaluations) {
  SphereOverSubTriangle over = sphere_node(shape, tri, node);
  SphereRange sigma = sphere_range(shape, tri, over);
  real D = longest(over.D);
  fit.corner = vec3(real(0.5) * (sigma.s.lo + sigma.s.hi));
  fit.edge = fit.corner;
  fit.position_error = real(0.5) * (sigma.s.hi - sigma.s.lo) * D;
  fit.tangent_error = UNBOUNDED;
  if (!prism_overlaps_ray(framed, node, sigma.s, tolerance)) return false;
  if (sigma.u.hi >= UNBOUNDED) return true;
  vec3 c = centre_of(node);
  vec2 middle = vec2(sigma.u.lo + sigma.u.hi, sigma.v.lo + sigma.v.hi) * real(0.5);
  vec2 half_width = vec2(sigma.u.hi - sigma.u.lo, sigma.v.hi - sigma.v.lo) * real(0.5);
  fit.corner = vec3(0.0);
  fit.edge = vec3(0.0);
  add_linear(fit, c, displacement(shape, tri, c), middle);
  ++evaluations;
  // From the centre to a corner one of the weights 1 and 2 changes by a third of the size and the other by two thirds, or
  // both by a third.
  real sigma_error = (half_width.x + half_width.y + largest(half_width)) * abs(node.size) / real(3.0);
  real turned = max(length3(direction_change(shape, tri, 1)), length3(direction_change(shape, tri, 2)));
  fit.position_error = sigma_error * D;
  fit.tangent_error = largest(half_width) * D + sigma_error * turned;
  return true;
}
