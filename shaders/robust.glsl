// The first root of a ray in a patch, or the certainty that there is none.
//
// The patch is seen in the ray's frame, where a root is a zero of S.xy over the triangle. Nodes, sub-triangles
// of dyadic size, are taken from a quadtree: one whose cage stays clear of the ray is done; one in which the cage
// allows one root at most (mean_jacobian) is solved by Newton's method, held within the node; where that ends on the
// node's border without a root, an interval Newton test must prove that there is none. What is not proven is
// divided. Silhouettes, where a ray grazes a node, are divided nine times; Newton then starts from every corner.
//
// After projecting the control points on two planes through the ray the test of the hull is Bezier clipping's
// (Nishita, Sederberg & Kakimoto 1990); the test of the tangents is Volino & Magnenat-Thalmann's (1994) criterion
// for a surface that a direction meets once, taken over all pairs of control vectors; interval Newton after Toth
// (1985), "On ray tracing parametric surfaces".

// What a search of a node found.
const uint FOUND_ROOT = 0u;
const uint PROVEN_MISS = 1u;
const uint UNDECIDED = 2u;  // neither a root nor that there is none

const int MOST_STEPS = 10;
// Of a node's size. Steps this small leave an error of their square.
const real SMALL_STEP = real(1e-4);
const int ONCE_STEPS = 6;
// In weights of the part: a step of this size leaves an error of its square.
const real ONCE_MOVED = real(1e-4);
// No step is smaller than the roundings of a weight.
const real WEIGHT_ROUNDINGS = real(2.4e-7);
// Beside the curves on which lines begin to miss a sphere sigma's roundings keep the steps of a `rough` search from getting
// smaller: the last may have this part of the node's size.
const real ROUGH_STEP = real(0.0625);
// What the loops of one node take of Traversal::steps, beside the evaluations.
const int VISIT_STEPS = 8;

// Orthonormal axes with z = view: Duff et al. 2017, "Building an orthonormal basis, revisited".
RayFrame ray_frame(vec3 anchor, vec3 view) {
  real turn = view.z < real(0.0) ? real(-1.0) : real(1.0);
  real a = real(-1.0) / (turn + view.z);
  real b = view.x * view.y * a;
  EXACT RayFrame frame;
  frame.anchor = anchor;
  frame.x = vec3(real(1.0) + turn * view.x * view.x * a, turn * b, -turn * view.x);
  frame.y = vec3(b, turn + view.y * view.y * a, -view.y);
  frame.z = view;
  frame.offset = vec2(0.0);
  frame.slope = vec2(0.0);
  frame.stretch = real(1.0);
  return frame;
}

vec3 rotated(RayFrame frame, vec3 a) {
  return vec3(dot3(frame.x, a), dot3(frame.y, a), dot3(frame.z, a));
}

// The patch in the frame's axes.
FramedPatch rotated_patch(RayFrame frame, uint shell, Triangle tri) {
  FramedPatch at;
  at.P0 = rotated(frame, vec3(tri.Position[0]) - frame.anchor);
  at.P1 = rotated(frame, vec3(tri.Position[1]) - frame.anchor);
  at.P2 = rotated(frame, vec3(tri.Position[2]) - frame.anchor);
  at.D0 = rotated(frame, corner_direction(shell, tri.Normal[0], tri.NormDot.x));
  at.D1 = rotated(frame, corner_direction(shell, tri.Normal[1], tri.NormDot.y));
  at.D2 = rotated(frame, corner_direction(shell, tri.Normal[2], tri.NormDot.z));
  return at;
}

// A point, and a direction, of the axes in the ray's frame.
vec3 sheared_point(RayFrame frame, vec3 p) { return vec3(vec2(p) - (frame.offset + frame.slope * p.z), p.z); }

vec3 sheared_direction(RayFrame frame, vec3 d) { return vec3(vec2(d) - frame.slope * d.z, d.z); }

FramedPatch sheared_patch(RayFrame frame, FramedPatch at) {
  FramedPatch framed;
  framed.P0 = sheared_point(frame, at.P0);
  framed.P1 = sheared_point(frame, at.P1);
  framed.P2 = sheared_point(frame, at.P2);
  framed.D0 = sheared_direction(frame, at.D0);
  framed.D1 = sheared_direction(frame, at.D1);
  framed.D2 = sheared_direction(frame, at.D2);
  return framed;
}

// What a coordinate across the ray may be off by. A ray that passes a patch's border by less than this meets it, so that
// none falls between two patches.
real position_tolerance(RayFrame frame, Triangle tri) { return ROUNDINGS * frame.stretch * farthest(frame.anchor, tri); }

// The quadratic of a cubic patch is sigma itself.
Displacement displacement_in(Shape shape, Triangle tri, SubpatchBounds bounds, vec3 w) {
  if (is_cubic(shape)) return bulged(vec3(bounds.edge) * real(2.0), w);
  return displacement_and_derivatives(shape, tri, w);
}

SurfacePoint evaluate_surface(Shape shape, Triangle tri, SubpatchBounds bounds, FramedPatch framed, vec3 w) {
  Displacement sigma = displacement_in(shape, tri, bounds, w);
  vec3 D = weigh(w, framed.D0, framed.D1, framed.D2);
  EXACT SurfacePoint at;
  at.S = weigh(w, framed.P0, framed.P1, framed.P2) + D * sigma.s;
  at.u = (framed.P1 - framed.P0) + D * sigma.u + (framed.D1 - framed.D0) * sigma.s;
  at.v = (framed.P2 - framed.P0) + D * sigma.v + (framed.D2 - framed.D0) * sigma.s;
  return at;
}

SubTriangle with_overlap(SubTriangle node) {
  SubTriangle wide;
  wide.origin = node.origin - vec3(OVERLAP * node.size);
  wide.size = (real(1.0) + real(3.0) * OVERLAP) * node.size;
  return wide;
}

real least(vec3 a) { return min(min(a.x, a.y), a.z); }

// The root of the triangle of a node's corners, in weights within it, drawn to the triangle.
vec3 flat_guess(ControlNet net) {
  vec2 u = net.b030 - net.b300;
  vec2 v = net.b003 - net.b300;
  real det = cross2(u, v);
  real a = -cross2(net.b300, v) / det;
  real b = cross2(net.b300, u) / det;
  vec3 l = max(vec3(real(1.0) - a - b, a, b), vec3(0.0));
  real sum = l.x + l.y + l.z;
  return sum > real(0.0) && sum < real(1e6) ? l / sum : vec3(real(1.0) / real(3.0));
}

// w drawn to the triangle.
vec3 held_inside(vec3 w) {
  vec3 inside = max(w, vec3(0.0));
  return inside / (inside.x + inside.y + inside.z);
}

// The point of the triangle's border that the ray passes closest, where the linearised surface f + u du + v dv about
// `from` has its root `target` outside: the foot of the ray on the edge, not the root's own, from which a grazing
// ray is far.
vec3 closest_on_border(vec3 from, vec3 target, vec2 f, vec2 u, vec2 v) {
  bool beyond0 = target.x <= target.y && target.x <= target.z;
  bool beyond1 = !beyond0 && target.y <= target.z;
  vec3 along = beyond0 ? vec3(0.0, -1.0, 1.0) : beyond1 ? vec3(-1.0, 0.0, 1.0) : vec3(-1.0, 1.0, 0.0);
  vec3 on_edge = beyond0   ? vec3(0.0, target.y + target.x, target.z)
                 : beyond1 ? vec3(target.x + target.y, 0.0, target.z)
                           : vec3(target.x + target.z, target.y, 0.0);
  vec2 r = f + u * (on_edge.y - from.y) + v * (on_edge.z - from.z);
  vec2 e = u * along.y + v * along.z;
  real square = e.x * e.x + e.y * e.y;
  real s = square > real(0.0) ? -(r.x * e.x + r.y * e.y) / square : real(0.0);
  return held_inside(on_edge + along * s);
}

// Newton's method from the weights l within a node. If the node is `certified` to hold one root at most,
// PROVEN_MISS is a proof. `rough`: a root may be known no better than ROUGH_STEP. On a root: its place along the ray, and its
// weights.
uint newton(Shape shape, Triangle tri, SubpatchBounds bounds, FramedPatch framed, SubTriangle node, MeanJacobian mean, bool certified, bool rough,
            real tolerance, vec3 l, OUT(real) z, OUT(vec3) weights, INOUT(uint) evaluations) {
  z = real(0.0);
  weights = weights_of(node, l);
  for (int i = 0; i < MOST_STEPS; ++i) {
    SurfacePoint at = evaluate_surface(shape, tri, bounds, framed, weights);
    ++evaluations;
    vec2 f = vec2(at.S);
    vec2 u = vec2(at.u);
    vec2 v = vec2(at.v);
    real slope = cross2(u, v);
    real du = -cross2(f, v) / slope;
    real dv = cross2(f, u) / slope;
    real step = max(abs(du), abs(dv));
    // A NaN ends here.
    if (!(step < real(1e6))) return UNDECIDED;
    vec3 from = weights;
    vec3 target = from + vec3(-du - dv, du, dv);
    vec3 inside = weights_in(node, target);
    // Where the ray grazes the surface the last digits of f move the step further than any bound on it.
    bool exact = largest(f) <= real(0.5) * tolerance;
    bool held = least(inside) < real(0.0) && !exact;
    if (held) {
      if (certified && newton_excludes(mean, f, weights_in(node, from), real(1e-5))) return PROVEN_MISS;
      target = weights_of(node, held_inside(inside));
    }
    weights = target;
    real moved = max(abs(target.y - from.y), abs(target.z - from.z));
    bool settled = rough && !held && i == MOST_STEPS - 1 && moved <= ROUGH_STEP * abs(node.size);
    if (moved > max(SMALL_STEP * abs(node.size), WEIGHT_ROUNDINGS) && !exact && !settled) continue;
    // Of a node's border only what it shares with the patch's is of interest: beyond the rest of it lie other
    // nodes, which overlap this one.
    if (held) return UNDECIDED;
    real gu = du;
    real gv = dv;
    if (least(target) < real(0.0)) {
      weights = closest_on_border(from, target, f, u, v);
      gu = weights.y - from.y;
      gv = weights.z - from.z;
      if (largest(f + u * gu + v * gv) > tolerance) return PROVEN_MISS;
    }
    z = at.S.z + at.u.z * gu + at.v.z * gv;
    return FOUND_ROOT;
  }
  return UNDECIDED;
}

// The root in a part through whose cone the ray goes steeply: it meets the enlarged part once at most, so that a root
// found beside the part proves that there is none in it. Newton's method with nothing to hold it; what it leaves
// undecided, roots on the patch's border among it, is for the search below.
uint intersect_by_newton(Shape shape, Triangle tri, SubpatchBounds bounds, FramedPatch framed, vec3 view, real tolerance, OUT(real) z,
               OUT(vec3) weights, INOUT(uint) evaluations) {
  vec3 Pu = framed.P1 - framed.P0;
  vec3 Pv = framed.P2 - framed.P0;
  vec3 Du = framed.D1 - framed.D0;
  vec3 Dv = framed.D2 - framed.D0;
  real size = abs(bounds.sub_triangle.w);
  bool steep = abs(dot3(vec3(bounds.cone), view)) > bounds.cone.w;
  vec3 next = vec3(bounds.sub_triangle) + vec3(bounds.sub_triangle.w / real(3.0));
  // Of the last step: where from, sigma there, how far, and what the surface spans there, seen along the ray.
  vec3 from = next;
  vec3 sigma = vec3(0.0);
  vec2 step = vec2(0.0);
  real slope = real(0.0);
  real longest = real(0.0);
  bool found = !steep;
  int left = ONCE_STEPS;
  // The condition stands at the end because llvmpipe runs the body once more, masked, if it stands at the head. Mesa
  // 22.3 then loses what a ray had when it left the loop before others, hence the choices by `found`.
  do {
    Displacement here = displacement_in(shape, tri, bounds, next);
    EXACT vec3 D = framed.D0 + Du * next.y + Dv * next.z;
    EXACT vec2 f = vec2(framed.P0) + vec2(Pu) * next.y + vec2(Pv) * next.z + vec2(D) * here.s;
    EXACT vec2 u = vec2(Pu) + vec2(D) * here.u + vec2(Du) * here.s;
    EXACT vec2 v = vec2(Pv) + vec2(D) * here.v + vec2(Dv) * here.s;
    real area = cross2(u, v);
    vec2 moved = vec2(-cross2(f, v) / area, cross2(f, u) / area);
    if (!found) ++evaluations;
    from = found ? from : next;
    sigma = found ? sigma : vec3(here.s, here.u, here.v);
    step = found ? step : moved;
    slope = found ? slope : area;
    longest = found ? longest : real(1.5) * (largest(u) + largest(v));
    found = found || largest(moved) <= ONCE_MOVED * size;
    next = from + vec3(-step.x - step.y, step.x, step.y);
    --left;
  } while (left > 0 && !found);
  weights = from + vec3(-step.x - step.y, step.x, step.y);
  EXACT vec3 D = framed.D0 + Du * from.y + Dv * from.z;
  EXACT real lifted =
      D.z * (sigma.x + sigma.y * step.x + sigma.z * step.y) + (Du.z * step.x + Dv.z * step.y) * sigma.x;
  EXACT real depth = framed.P0.z + Pu.z * weights.y + Pv.z * weights.z + lifted;
  z = depth;
  real outside = -least(weights);
  real outside_subpatch = -least((weights - vec3(bounds.sub_triangle)) / bounds.sub_triangle.w);
  if (!steep || !(largest(step) <= ONCE_MOVED * size) || !(outside_subpatch <= CONE_MARGIN)) return UNDECIDED;
  if (outside <= real(0.0)) return outside_subpatch <= OVERLAP ? FOUND_ROOT : PROVEN_MISS;
  // So far from the line of an edge, over the longest of which 1.5 (|u| + |v|) is: twice the reach, for the surface's
  // bend between here and there.
  return outside * abs(slope) > real(2.0) * tolerance * longest ? PROVEN_MISS : UNDECIDED;
}

void keep_nearest(real z, vec3 weights, uint triangle, uint subpatch, real nearest, INOUT(Hit) hit) {
  if (z >= nearest && (z < hit.z || (z == hit.z && subpatch < hit.subpatch))) {
    hit.z = z;
    hit.weights = weights;
    hit.triangle = triangle;
    hit.subpatch = subpatch;
  }
}

// A patch without displacement: its plane is met once, no node is looked at.
void intersect_flat(FramedPatch framed, uint triangle, uint subpatch, real tolerance, real nearest, INOUT(Hit) hit) {
  vec2 P = vec2(framed.P0);
  vec2 u = vec2(framed.P1) - P;
  vec2 v = vec2(framed.P2) - P;
  real det = cross2(u, v);
  // Seen so much from its edge that it is thinner than the grain: what is behind it, or beside it, is met.
  if (!(abs(det) > tolerance * max(largest(u), largest(v)))) return;
  real a = -cross2(P, v) / det;
  real b = cross2(P, u) / det;
  vec3 w = vec3(real(1.0) - a - b, a, b);
  bool inside = least(w) >= real(0.0);
  vec3 held = inside ? w : closest_on_border(vec3(1.0, 0.0, 0.0), w, P, u, v);
  vec2 missed = P + u * held.y + v * held.z;
  if (inside || largest(missed) <= tolerance) {
    real z = framed.P0.z + (framed.P1.z - framed.P0.z) * held.y + (framed.P2.z - framed.P0.z) * held.z;
    keep_nearest(z, held, triangle, subpatch, nearest, hit);
  }
}

// The quadratic for a node. That of the cage, but for a linear part that moves it onto the surface at the node's
// centre, to second order: what it strays from there shrinks with the node.
Fit fit_bounds(Shape shape, Triangle tri, SubpatchBounds bounds, SubTriangle node, bool whole, INOUT(uint) evaluations) {
  Fit fit;
  fit.corner = vec3(bounds.corner);
  fit.edge = vec3(bounds.edge);
  fit.position_error = bounds.corner.w;
  fit.tangent_error = bounds.edge.w;
  if (bounds.gradient_lipschitz == real(0.0) || whole) return fit;
  vec3 c = centre_of(node);
  Displacement sigma = displacement_and_derivatives(shape, tri, c);
  ++evaluations;
  real e = sigma.s - blossom(fit.corner, fit.edge, c, c);
  real eu = sigma.u - real(2.0) * blossom(fit.corner, fit.edge, c, vec3(-1.0, 1.0, 0.0));
  real ev = sigma.v - real(2.0) * blossom(fit.corner, fit.edge, c, vec3(-1.0, 0.0, 1.0));
  add_linear(fit, c, e, vec2(eu, ev));
  // No point of a widened node is farther from its centre than this, in the weights 1 and 2: sqrt(5) / 3 of its
  // size.
  real away = real(0.7454) * (real(1.0) + real(3.0) * OVERLAP) * abs(node.size);
  fit.position_error = min(fit.position_error, real(0.5) * bounds.gradient_lipschitz * away * away);
  fit.tangent_error = min(fit.tangent_error, bounds.gradient_lipschitz * away * (real(1.0) + away));
  return fit;
}

// Roots of a ray in one part of a patch, from the node walk.path on; the nearest beyond `nearest` that is before
// walk.hit becomes it. walk.path is WHOLE again at the end, or else where the steps ended. kinks: whether sigma may have
// one in some part.
void intersect_subpatch(Shape shape, bool may_be_nonsmooth, Triangle tri, SubpatchBounds bounds, uint subpatch, RayFrame frame, vec3 view, real nearest,
               INOUT(Traversal) traversal) {
  FramedPatch framed = sheared_patch(frame, rotated_patch(frame, shape.shell, tri));
  real tolerance = position_tolerance(frame, tri);
  if (traversal.path == WHOLE) {
    real z;
    vec3 weights;
    uint found = intersect_by_newton(shape, tri, bounds, framed, view, tolerance, z, weights, traversal.counts.evaluations);
    if (found == FOUND_ROOT) keep_nearest(z, weights, bounds.triangle, subpatch, nearest, traversal.hit);
    if (found != UNDECIDED) return;
  }
  if (bounds.is_flat == 1u) {
    intersect_flat(framed, bounds.triangle, subpatch, tolerance, nearest, traversal.hit);
    return;
  }
  SubTriangle node = sub_triangle_at(bounds.sub_triangle, traversal.path);
  do {
    uint evaluations = traversal.counts.evaluations;
    bool last = traversal.path >= SMALLEST;
    SubTriangle wide = with_overlap(node);
    Fit fit;
    bool near = true;
    if (may_be_nonsmooth && bounds.gradient_lipschitz == NONSMOOTH) {
      near = ranged_fit(shape, tri, framed, wide, tolerance, fit, traversal.counts.evaluations);
    } else {
      fit = fit_bounds(shape, tri, bounds, node, traversal.path == WHOLE, traversal.counts.evaluations);
    }
    ControlNet net = control_net(framed, fit.corner, fit.edge, wide);
    bool divide = false;
    if (near && hull_overlaps_ray(net, frame.stretch * fit.position_error + tolerance)) {
      real position_error = frame.stretch * fit.tangent_error * abs(wide.size) / real(3.0);
      MeanJacobian mean = mean_jacobian(tangents(net), position_error);
      bool certified = mean.contraction_bound < real(1.0);
      // Where the steps must get small but for roundings, and no smaller node is left.
      bool rough = may_be_nonsmooth && bounds.gradient_lipschitz == NONSMOOTH && certified && last;
      divide = !certified && !last;
      int starts = divide ? 0 : certified ? 1 : 3;
      vec3 start = certified ? flat_guess(net) : vec3(1.0, 0.0, 0.0);
      for (int k = 0; k < starts; ++k) {
        real z;
        vec3 weights;
        uint found = newton(shape, tri, bounds, framed, wide, mean, certified, rough, tolerance, start, z, weights,
                            traversal.counts.evaluations);
        if (found == FOUND_ROOT) keep_nearest(z, weights, bounds.triangle, subpatch, nearest, traversal.hit);
        divide = certified && found == UNDECIDED && !last;
        start = vec3(start.z, start.x, start.y);
      }
    }
    traversal.steps -= VISIT_STEPS + int(traversal.counts.evaluations - evaluations);
    if (divide) {
      node = child(node, 0u);
      traversal.path = traversal.path << 2;
    } else {
      // On to the next sibling, or that of the nearest ancestor that has one.
      while ((traversal.path & 3u) == 3u) {
        node = parent(node, 3u);
        traversal.path = traversal.path >> 2;
        --traversal.steps;
      }
      if (traversal.path != WHOLE) {
        node = child(parent(node, traversal.path & 3u), (traversal.path & 3u) + 1u);
        ++traversal.path;
      }
    }
  } while (traversal.path != WHOLE && traversal.steps > 0);
}
