// The types of the robust solver.

// A frame in which a ray is the line x = y = 0: orthonormal axes about an anchor, sheared by the ray, which in them
// is at (offset + slope z, z). A ray's own frame has it as third axis; all rays of an image share the camera's.
struct RayFrame {
  vec3 anchor;
  vec3 x;
  vec3 y;
  vec3 z;
  vec2 offset;
  vec2 slope;
  real stretch;  // sqrt(1 + slope^2): length along the ray for a change of z, and the most that x, y grow by
};

// A patch in a ray's frame.
struct FramedPatch {
  vec3 P0;
  vec3 P1;
  vec3 P2;
  vec3 D0;
  vec3 D1;
  vec3 D2;
};

// A sub-triangle of a patch: w = origin + size l for weights l within it. Halving is exact.
struct SubTriangle {
  vec3 origin;
  real size;
};

// A quadratic near sigma, and how far S and its tangents stray from T + q D.
struct Fit {
  vec3 corner;
  vec3 edge;
  real position_error;
  real tangent_error;
};

// A linear function of the weights by its values at a node's corners.
struct Corners {
  vec3 a;
  vec3 b;
  vec3 c;
};

// Ranges, vec2(least, largest), of sigma and its derivatives over a node.
struct SphereRange {
  vec2 s;
  vec2 u;
  vec2 v;
};

// Control points of a cubic Bezier triangle, seen along the ray; b_ijk belongs to w_0^i w_1^j w_2^k.
struct ControlNet {
  vec2 b300;
  vec2 b030;
  vec2 b003;
  vec2 b210;
  vec2 b120;
  vec2 b021;
  vec2 b012;
  vec2 b102;
  vec2 b201;
  vec2 b111;
};

// Control vectors of a net's derivatives, over 3, u_i and v_i those of the same Bernstein polynomial: S_u and S_v of
// the cage are the same convex combination of them.
struct Tangents {
  vec2 u0;
  vec2 u1;
  vec2 u2;
  vec2 u3;
  vec2 u4;
  vec2 u5;
  vec2 v0;
  vec2 v1;
  vec2 v2;
  vec2 v3;
  vec2 v4;
  vec2 v5;
};

// The mean J0 = (u, v) of a node's tangents, over 3, and how far others are from it.
struct MeanJacobian {
  vec2 u;
  vec2 v;
  real area;    // u x v
  real contraction_bound;  // the most by which 1 - J0^-1 J lengthens a vector
};

// The surface at one point, in a ray's frame.
struct SurfacePoint {
  vec3 S;
  vec3 u;
  vec3 v;
};

// Places along a ray that has met nothing yet, and along one that need not meet anything any more.
const real NO_HIT_YET = real(1e30);
const real TRAVERSAL_ENDED = real(-1e30);

// The nearest root so far.
struct Hit {
  real z;
  vec3 weights;
  uint triangle;
  uint subpatch;  // the triangle's part; of two roots at the same place the one in the first part counts
};

// The work done for a ray.
struct Counts {
  uint evaluations;
  uint candidates;
  uint bytes;  // of the scene that were read by its invocation, on the way through the patches, since it last began
};

// How far a ray has come through the list, of cages or of triangles.
struct Traversal {
  Hit hit;
  Counts counts;
  uint item;  // of the list, the next
  uint path;  // of nodes within it, the next: WHOLE, or 4 p + k for child k of node p
  int steps;  // that are left until it pauses: no loop iteration is begun without one
};
