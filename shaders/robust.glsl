// The first root of a ray in a patch, or the certainty that there is none.
//
// In the ray's frame a root is a zero of S.xy over the triangle. A subpatch is searched as a quadtree of sub-triangles,
// its nodes, depth first:
// - A node whose control points, widened by the position error, stay on one side of the ray is left out. The control
//   points are projected along the ray, as in Bezier clipping (Nishita, Sederberg & Kakimoto 1990, "Ray tracing trimmed
//   rational surface patches").
// - A node that passes the contraction test (subpatch_bounds.glsl) has one root at most. Newton's method, held within the
//   node, finds it, or ends on the node's border, where newton_excludes must prove that there is none.
// - What is not proven is divided in four, up to nine times. A node of the last level that fails the contraction test
//   lies where the ray grazes the surface; Newton's method then starts from each of its corners, and finding nothing
//   proves nothing.
// Before all that intersect_by_newton tries Newton's method on the whole subpatch, with a cone that the bake has proven.

// What a search of a node found.
const uint FOUND_ROOT = 0u;
const uint PROVEN_MISS = 1u;
const uint UNDECIDED = 2u;  // neither a root nor that there is none

// newton(): steps at most.
const int MOST_STEPS = 10;
// newton() ends with a step of at most this part of the node's size; it leaves an error of the order of its square.
const real SMALL_STEP = real(1e-4);
// Where f is as small as its roundings already, a last step of up to this part of the node's size is taken: over that the
// surface bends by some roundings. A longer one, on a ray that all but touches the surface, would lead off the ray.
const real LAST_STEP = real(0.01);
// No step is smaller than the roundings of a weight.
const real WEIGHT_ROUNDINGS = real(2.4e-7);
// Beside the curves on which lines begin to miss a vertex's sphere the roundings of sigma keep Newton's steps from getting
// small. In a `rough` search the last of MOST_STEPS is accepted if it is at most this part of the node's size.
const real ROUGH_STEP = real(0.0625);
// intersect_by_newton(): steps at most, and the part of the subpatch's size that the last may have. Half the square of that,
// times what the tangents differ by over the subpatch relative to themselves, is the error it leaves: some 1e-8 of the
// subpatch's size, less than a position's roundings. The subpatch is smooth; newton() has nonsmooth ones, too, and smaller
// steps.
const int ONCE_STEPS = 6;
const real ONCE_MOVED = real(5e-4);
// Where the surface is not cubic, as many steps come before these that take the quadratic of the bounds for sigma: it is
// much cheaper, and so close that few of the others are needed.
const int QUADRATIC_STEPS = 2;
// What the loops for one node count for in Traversal::steps, without the evaluations.
const int VISIT_STEPS = 8;
// The evaluations of one subpatch for one ray, at most, whatever numbers they are fed, for no loop ends by a comparison of
// numbers alone. A quadtree of ten levels has 1 + 4 + ... + 4^9 nodes. Each takes one evaluation for its fit and MOST_STEPS
// for Newton's method, on the last level from three corners. intersect_by_newton comes before. A ray takes so many for each
// subpatch of its list or tree.
const uint MOST_EVALUATIONS = uint(ONCE_STEPS) + 87381u * (1u + uint(MOST_STEPS)) + 262144u * (1u + 3u * uint(MOST_STEPS));

// Orthonormal axes with z = view: Duff et al. 2017, "Building an orthonormal basis, revisited".
RayFrame ray_frame(vec3 anchor, vec3 view) {
  real turn = view.z < real(0.0) ? real(-1.0) : real(1.0);
  real a = divide(real(-1.0), turn + view.z);
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

// The patch in the frame's axes, not sheared yet.
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

// From the frame's axes to the ray's frame: a point, a direction, a patch.
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

// What a coordinate across the ray may be off by, rounding in single precision. A ray that passes a patch's border by less
// than this meets it, so that none falls between two patches.
real position_tolerance(RayFrame frame, Triangle tri) { return ROUNDINGS * frame.stretch * farthest(frame.anchor, tri); }

// sigma at weights w. Where the surface is cubic, the quadratic of the bounds is sigma itself: its edge coefficients are
// half of the edges' bulges.
Displacement displacement_in(Shape shape, Triangle tri, SubpatchBounds bounds, vec3 w) {
  if (is_cubic(shape)) return bulged(vec3(bounds.edge) * real(2.0), w);
  return displacement_and_derivatives(shape, tri, w);
}

// The quadratic of the bounds and its derivatives.
Displacement quadratic_displacement(SubpatchBounds bounds, vec3 w) {
  vec3 corner = vec3(bounds.corner);
  vec3 edge = vec3(bounds.edge);
  Displacement q;
  q.s = blossom(corner, edge, w, w);
  q.u = real(2.0) * blossom(corner, edge, w, vec3(-1.0, 1.0, 0.0));
  q.v = real(2.0) * blossom(corner, edge, w, vec3(-1.0, 0.0, 1.0));
  return q;
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

real least(vec3 a) { return min(min(a.x, a.y), a.z); }

// Where Newton's method starts: the root of the flat triangle of a node's corners, in weights within the node, moved into
// the triangle.
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

// The weights, moved into the triangle: negative ones set to 0, the sum to 1.
vec3 held_inside(vec3 w) {
  vec3 inside = max(w, vec3(0.0));
  return inside / (inside.x + inside.y + inside.z);
}

// The weights of the point of the triangle's border that the ray passes closest, for a root `target` outside the triangle
// of the linearised surface f + u du + v dv about the weights `from`. On the edge that the root lies beyond, it is the
// foot of the perpendicular from the ray, in the plane across the ray; the point of the edge nearest to the root, in
// weights, can be far from a ray that grazes the surface.
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

// What newton() searches, and how.
struct NewtonQuery {
  FramedPatch framed;
  SubTriangle node;
  MeanJacobian mean;  // of the node
  bool certified;     // mean.contraction_bound < 1: the node holds one root at most
  bool rough;         // the steps may stay as large as ROUGH_STEP
  real tolerance;     // position_tolerance
};

// Newton's method for S.xy = 0 from the weights l within the node, each step held within it. FOUND_ROOT gives the root's
// z and its weights in the patch; PROVEN_MISS is a proof that the node holds no root if the query is certified, or that
// the root that the method converged to lies beside the patch.
uint newton(Shape shape, Triangle tri, SubpatchBounds bounds, NewtonQuery query, vec3 l, OUT(real) z,
            OUT(vec3) weights, INOUT(uint) evaluations) {
  z = real(0.0);
  weights = weights_of(query.node, l);
  for (int i = 0; i < MOST_STEPS; ++i) {
    SurfacePoint at = evaluate_surface(shape, tri, bounds, query.framed, weights);
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
    vec3 inside = weights_in(query.node, target);
    // Where the ray grazes the surface the rounding of f alone makes steps that never get small: there a small f is enough.
    bool exact = largest(f) <= real(0.5) * query.tolerance;
    bool held = least(inside) < real(0.0) && !exact;
    if (exact && step > LAST_STEP * abs(query.node.size)) {
      du = real(0.0);
      dv = real(0.0);
      target = from;
    }
    if (held) {
      if (query.certified && newton_excludes(query.mean, f, weights_in(query.node, from), real(1e-5))) return PROVEN_MISS;
      target = weights_of(query.node, held_inside(inside));
    }
    weights = target;
    real moved = max(abs(target.y - from.y), abs(target.z - from.z));
    bool settled = query.rough && !held && i == MOST_STEPS - 1 && moved <= ROUGH_STEP * abs(query.node.size);
    if (moved > max(SMALL_STEP * abs(query.node.size), WEIGHT_ROUNDINGS) && !exact && !settled) continue;
    // The method was held on the node's border without a root. A root beyond it belongs to the neighbour, which overlaps
    // this node, or lies beside the patch.
    if (held) return UNDECIDED;
    real gu = du;
    real gv = dv;
    // A root beside the patch is a hit if the ray passes the patch's border within the tolerance.
    if (least(target) < real(0.0)) {
      weights = closest_on_border(from, target, f, u, v);
      gu = weights.y - from.y;
      gv = weights.z - from.z;
      if (largest(f + u * gu + v * gv) > query.tolerance) return PROVEN_MISS;
    }
    z = at.S.z + at.u.z * gu + at.v.z * gv;
    return FOUND_ROOT;
  }
  return UNDECIDED;
}

// Newton's method on a whole subpatch, from its centre, with nothing to hold it. It decides only for a ray within the
// subpatch's cone: such a ray meets the enlarged subpatch once at most, so a root that it finds beside the subpatch, but
// in the enlarged one, proves that the subpatch has none. What it leaves undecided, roots close to the patch's border for
// example, is for intersect_subpatch.
uint intersect_by_newton(Shape shape, Triangle tri, SubpatchBounds bounds, FramedPatch framed, vec3 view,
                         real tolerance, OUT(real) z, OUT(vec3) weights, INOUT(uint) evaluations) {
  vec3 Pu = framed.P1 - framed.P0;
  vec3 Pv = framed.P2 - framed.P0;
  vec3 Du = framed.D1 - framed.D0;
  vec3 Dv = framed.D2 - framed.D0;
  real size = abs(bounds.sub_triangle.w);
  bool steep = abs(dot3(vec3(bounds.cone), view)) > bounds.cone.w;
  vec3 next = vec3(bounds.sub_triangle) + vec3(bounds.sub_triangle.w / real(3.0));
  // Of the last step: where from; sigma and its derivatives there; the step; S_u x S_v across the ray, and a bound on the
  // length of an edge.
  vec3 from = next;
  vec3 sigma = vec3(0.0);
  vec2 step = vec2(0.0);
  real slope = real(0.0);
  real longest = real(0.0);
  bool found = !steep;
  int left = is_cubic(shape) ? ONCE_STEPS : QUADRATIC_STEPS + ONCE_STEPS;
  // The condition is at the end because llvmpipe runs the body once more, masked, if it is at the head. Mesa 22.3 then
  // loses the values of a ray that left the loop before others of its subgroup, hence the choices by `found`.
  do {
    bool quadratic = !is_cubic(shape) && left > ONCE_STEPS;
    Displacement here;
    if (quadratic) {
      here = quadratic_displacement(bounds, next);
    } else {
      here = displacement_in(shape, tri, bounds, next);
    }
    EXACT vec3 D = framed.D0 + Du * next.y + Dv * next.z;
    EXACT vec2 f = vec2(framed.P0) + vec2(Pu) * next.y + vec2(Pv) * next.z + vec2(D) * here.s;
    EXACT vec2 u = vec2(Pu) + vec2(D) * here.u + vec2(Du) * here.s;
    EXACT vec2 v = vec2(Pv) + vec2(D) * here.v + vec2(Dv) * here.s;
    real area = cross2(u, v);
    vec2 moved = vec2(-cross2(f, v) / area, cross2(f, u) / area);
    if (!found && !quadratic) ++evaluations;
    from = found ? from : next;
    sigma = found ? sigma : vec3(here.s, here.u, here.v);
    step = found ? step : moved;
    slope = found ? slope : area;
    longest = found ? longest : real(1.5) * (largest(u) + largest(v));
    found = found || (!quadratic && largest(moved) <= ONCE_MOVED * size);
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
  // Beside the patch: seen along the ray the root is `outside` * |slope| over an edge's length away from the line of that
  // edge; 1.5 (|u| + |v|) is no less than the longest edge. Twice the tolerance leaves room for the surface's curvature.
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

// A patch without displacement: the ray meets its plane in closed form.
void intersect_flat(FramedPatch framed, uint triangle, uint subpatch, real tolerance, real nearest, INOUT(Hit) hit) {
  vec2 P = vec2(framed.P0);
  vec2 u = vec2(framed.P1) - P;
  vec2 v = vec2(framed.P2) - P;
  real det = cross2(u, v);
  // A triangle that is thinner than the tolerance, seen along the ray, is missed: what is behind it or beside it is hit.
  if (!(abs(det) > tolerance * max(largest(u), largest(v)))) return;
  real a = -cross2(P, v) / det;
  real b = cross2(P, u) / det;
  // The areas round relative to the triangle's length, which moves the root in a triangle that looks thin by much more than
  // its coordinates round. One step of Newton's method undoes that.
  vec2 f = P + u * a + v * b;
  a -= cross2(f, v) / det;
  b += cross2(f, u) / det;
  vec3 w = vec3(real(1.0) - a - b, a, b);
  bool inside = least(w) >= real(0.0);
  vec3 held = inside ? w : closest_on_border(vec3(1.0, 0.0, 0.0), w, P, u, v);
  vec2 missed = P + u * held.y + v * held.z;
  if (inside || largest(missed) <= tolerance) {
    real z = framed.P0.z + (framed.P1.z - framed.P0.z) * held.y + (framed.P2.z - framed.P0.z) * held.z;
    keep_nearest(z, held, triangle, subpatch, nearest, hit);
  }
}

// The quadratic for a node. For the whole subpatch it is the one of the bounds. For smaller nodes a linear function is added
// that gives it the value and the gradient of sigma at the node's centre: the errors then shrink with the node, by its
// size squared for the position and by its size for the tangents, as the gradient of the difference has the Lipschitz
// constant bounds.gradient_lipschitz / |D|.
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
  Displacement q = quadratic_displacement(bounds, c);
  add_linear(fit, c, sigma.s - q.s, vec2(sigma.u - q.u, sigma.v - q.v));
  // No point of the node with its overlap is farther from the centre than this, in the plane of the weights 1 and 2:
  // sqrt(5) / 3 of its size.
  real away = real(0.7454) * (real(1.0) + real(3.0) * OVERLAP) * abs(node.size);
  fit.position_error = min(fit.position_error, real(0.5) * bounds.gradient_lipschitz * away * away);
  fit.tangent_error = min(fit.tangent_error, bounds.gradient_lipschitz * away * (real(1.0) + away));
  return fit;
}

real size_of(vec3 a) { return abs(a.x) + abs(a.y) + abs(a.z); }

// Whether the numbers of a patch and its bounds are those of a surface. A NaN or an infinity, which a ray or a scene should
// not have, leaves out no node: a search would go through all of them.
bool is_searchable(FramedPatch framed, SubpatchBounds bounds, real tolerance) {
  real size = size_of(framed.P0) + size_of(framed.P1) + size_of(framed.P2) + size_of(framed.D0) + size_of(framed.D1) +
              size_of(framed.D2) + size_of(vec3(bounds.corner)) + size_of(vec3(bounds.edge)) + tolerance;
  // Written so that a NaN is no size.
  return size < LARGEST;
}

// The roots of a ray in a subpatch that intersect_by_newton leaves undecided, from the node traversal.path on: the nearest
// one beyond `nearest` that comes before traversal.hit becomes it. Afterwards traversal.path is WHOLE if the search is
// finished, or else the node at which the steps ran out. `may_be_nonsmooth`: whether any subpatch of the scene is marked
// NONSMOOTH; a constant, by which kernels leave the code for those out.
void search_subpatch(Shape shape, bool may_be_nonsmooth, Triangle tri, SubpatchBounds bounds, uint subpatch,
                     RayFrame frame, FramedPatch framed, real tolerance, real nearest, INOUT(Traversal) traversal) {
  if (bounds.is_flat == 1u) {
    intersect_flat(framed, bounds.triangle, subpatch, tolerance, nearest, traversal.hit);
    return;
  }
  SubTriangle node = sub_triangle_at(bounds.sub_triangle, traversal.path);
  bool searchable = is_searchable(framed, bounds, tolerance);
  do {
    uint evaluations = traversal.counts.evaluations;
    bool last = traversal.path >= SMALLEST;
    SubTriangle wide = with_overlap(node);
    Fit fit;
    bool near = searchable;
    if (may_be_nonsmooth && bounds.gradient_lipschitz == NONSMOOTH) {
      near = ranged_fit(shape, tri, framed, wide, tolerance, fit, traversal.counts.evaluations) && searchable;
    } else {
      fit = fit_bounds(shape, tri, bounds, node, traversal.path == WHOLE, traversal.counts.evaluations);
    }
    ControlNet net = control_net(framed, fit.corner, fit.edge, wide);
    bool divide = false;
    if (near && hull_overlaps_ray(net, frame.stretch * fit.position_error + tolerance)) {
      // By the weights within the node, over 3, as the control vectors are.
      real tangent_error = frame.stretch * fit.tangent_error * abs(wide.size) / real(3.0);
      NewtonQuery query;
      query.framed = framed;
      query.node = wide;
      query.mean = mean_jacobian(tangents(net), tangent_error);
      query.certified = query.mean.contraction_bound < real(1.0);
      // Newton's steps would get small but for roundings, and there is no smaller node to try.
      query.rough = may_be_nonsmooth && bounds.gradient_lipschitz == NONSMOOTH && query.certified && last;
      query.tolerance = tolerance;
      divide = !query.certified && !last;
      int starts = divide ? 0 : query.certified ? 1 : 3;
      vec3 start = query.certified ? flat_guess(net) : vec3(1.0, 0.0, 0.0);
      for (int k = 0; k < starts; ++k) {
        real z;
        vec3 weights;
        uint found = newton(shape, tri, bounds, query, start, z, weights, traversal.counts.evaluations);
        if (found == FOUND_ROOT) keep_nearest(z, weights, bounds.triangle, subpatch, nearest, traversal.hit);
        divide = query.certified && found == UNDECIDED && !last;
        start = vec3(start.z, start.x, start.y);
      }
    }
    traversal.steps -= VISIT_STEPS + int(traversal.counts.evaluations - evaluations);
    if (divide) {
      node = child(node, 0u);
      traversal.path = traversal.path << 2;
    } else {
      // Go on to the next sibling, or to that of the nearest ancestor that has one.
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

// The roots of a ray in one subpatch, as above, but with intersect_by_newton first. `view`: the ray's direction in the
// scene's axes, of unit length.
void intersect_subpatch(Shape shape, bool may_be_nonsmooth, Triangle tri, SubpatchBounds bounds, uint subpatch,
                        RayFrame frame, vec3 view, real nearest, INOUT(Traversal) traversal) {
  FramedPatch framed = sheared_patch(frame, rotated_patch(frame, shape.shell, tri));
  real tolerance = position_tolerance(frame, tri);
  if (traversal.path == WHOLE) {
    real z;
    vec3 weights;
    uint found =
        intersect_by_newton(shape, tri, bounds, framed, view, tolerance, z, weights, traversal.counts.evaluations);
    if (found == FOUND_ROOT) keep_nearest(z, weights, bounds.triangle, subpatch, nearest, traversal.hit);
    if (found != UNDECIDED) return;
  }
  search_subpatch(shape, may_be_nonsmooth, tri, bounds, subpatch, frame, framed, tolerance, nearest, traversal);
}
