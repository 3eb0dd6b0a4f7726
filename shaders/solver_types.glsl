// The types of the robust solver. A node is a sub-triangle of the quadtree that it searches.

// A frame of coordinates about an anchor with orthonormal axes x, y, z in which a ray is sheared onto the third axis:
// in the axes the ray is at (offset + slope z, z), in the frame at (0, 0, z). A frame made for one ray has that as its
// axis z, without a shear; the rays of an image all have the camera's axes.
struct RayFrame {
  vec3 anchor;
  vec3 x;
  vec3 y;
  vec3 z;
  vec2 offset;
  vec2 slope;
  real stretch;  // sqrt(1 + slope^2): length along the ray for a change of z, and the most by which the shear lengthens
};

// A quadratic near sigma over a node, and what it leaves open.
struct Fit {
  vec3 corner;  // Bernstein coefficients of the quadratic q over the whole patch, as in SubpatchBounds
  vec3 edge;
  real position_error;  // S is no farther from T + q D, a length
  real tangent_error;   // S_u and S_v are no farther from those of T + q D
};

// The mean J0 = (u, v) of a node's tangents, divided by 3, and how far the others are from it.
struct MeanJacobian {
  vec2 u;
  vec2 v;
  real area;               // u x v
  real contraction_bound;  // |1 - J0^-1 J| at most, J the tangents at any point of the node; less than 1: one root at most
};

// The surface at one point, in a ray's frame: S and its derivatives by the weights 1 and 2 of the patch.
struct SurfacePoint {
  vec3 S;
  vec3 u;
  vec3 v;
};

// Values of Hit::z: of a ray that has met nothing yet, and of one that need not be followed any further.
const real NO_HIT_YET = real(1e30);
const real TRAVERSAL_ENDED = real(-1e30);

// The nearest root so far.
struct Hit {
  real z;  // in the ray's frame
  vec3 weights;
  uint triangle;
  uint subpatch;  // where it was found; of two roots at the same z that of the subpatch with the lower number counts
};

// The work done for a ray.
struct Counts {
  uint evaluations;  // of the surface or of a field
  uint candidates;   // subpatches or triangles whose bounds the ray meets
  uint bytes;        // of the scene, read by this invocation since the ray last began or went on
};

// How far a ray has come through the list of subpatches or triangles, or through the tree.
struct Traversal {
  Hit hit;
  Counts counts;
  uint item;  // the next of the list, or of the tree (BvhNode)
  uint path;  // within it, the next node: WHOLE, or 4 p + k for child k of the node with path p
  int steps;  // left before the ray pauses: no iteration of a loop begins without one
};
