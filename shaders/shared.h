// What C++ and GLSL share: buffer layouts, binding numbers, constants. Declared here, once.
//
// This file is included by the shaders and, through app/surface/shared.h, by C++ (inside a
// namespace in which vec4 and uint are GLM's; there is no include guard because each scalar type
// gets a namespace of its own). Only vec4 and 4-byte scalars in groups of four appear, so std140,
// std430 and C++ agree on every offset; tests/layout_test.cpp proves it against the compiled
// SPIR-V.

// A baked triangle, 192 bytes: the structure of the thesis, member for member.
struct Triangle {
  vec4 Position[3];    // xyz: vertex
  vec4 Normal[3];      // xyz: unit vertex normal
  vec4 TriNormal;      // xyz: unit face normal n; w: length of the longest edge
  vec4 NormDot;        // component i: dot(Normal[i], n)
  vec4 Domain;         // xyz, w: centre and radius of a ball that contains the displaced patch
  vec4 VertexData[3];  // at vertex i: x, y: curvature toward its lower- and higher-numbered
                       // neighbour; z: interior angle in radians
};

// A part of a displaced triangle, 96 bytes: what the robust solver knows of it before it looks.
// With triangle weights w the part is w = sub_triangle.xyz + sub_triangle.w l, l the weights within
// the part; its sigma is about the quadratic q with the Bernstein coefficients corner and edge.
struct SubpatchBounds {
  vec4 ball;          // xyz, w: centre and radius of a ball that contains the part
  vec4 sub_triangle;  // xyz: weights of the part's origin; w: its size, 1 for the whole, negative
                      // if turned over
  vec4 corner;  // xyz: q(e_0, e_0), q(e_1, e_1), q(e_2, e_2); w: how far S strays from T + q D,
                // length
  vec4 edge;    // xyz: q(e_0, e_1), q(e_1, e_2), q(e_0, e_2); w: the same of S_u and S_v
  // No line along a unit vector d with |dot(d, cone.xyz)| > cone.w, cone.xyz a unit vector too,
  // meets the part, enlarged by CONE_MARGIN, twice. w is NO_CONE if nothing is known of any d.
  vec4 cone;
  uint triangle;
  uint is_flat;              // 1: sigma is 0
  float gradient_lipschitz;  // Lipschitz constant of the gradient of sigma - q in the weights 1 and
                             // 2, times |D|; NONSMOOTH if the gradient may jump
  uint skip;  // a group: how many cages follow that lie within its ball, and it has no part of its
              // own
};

// One of the eight children of a node of the tree over the parts' boxes, 32 bytes; node n has
// entries 8 n to 8 n + 7, in the order of octants: bit k of a child's number is set if it lies on
// the far side along axis k.
struct BvhEntry {
  float lo_x;  // of a box that contains the child's parts
  float lo_y;
  float lo_z;
  uint link;  // first entry of the child's node, BVH_LEAF + index of the part, or BVH_EMPTY
  float hi_x;
  float hi_y;
  float hi_z;
  uint next;  // the entry with which a ray goes on that is through with this one, BVH_END if none
};

// A part as a frame's camera sees it, 192 bytes, written anew for every frame. Image positions are
// in pixels, y down, (0, 0) the top left corner.
struct ProjectedSubpatch {
  // The part is seen within the box, and on the inner side of three lines: an image position p is
  // outside if lines_x[i] p.x + lines_y[i] p.y > lines_at[i].
  vec4 box;       // least x, least y, largest x, largest y
  vec4 lines_x;   // xyz; w: the depth in the camera's frame at which it begins
  vec4 lines_y;   // xyz; w: index of the triangle, less than 2^24
  vec4 lines_at;  // xyz
  // The patch in the axes of the camera's frame.
  vec4 P0;  // xyz: vertex; w: SubpatchBounds::edge.x
  vec4 P1;
  vec4 P2;
  vec4 D0;  // xyz: direction; w: SubpatchBounds::node.x
  vec4 D1;
  vec4 D2;
  vec4 cone;   // SubpatchBounds::cone
  vec4 sizes;  // x: SubpatchBounds::node.w; y: the grain of a ray down the axis
};

// Where buffers are that are too large to be bound: low and high half of their addresses.
struct Addresses {
  uint triangles_low;
  uint triangles_high;
  uint subpatches_low;
  uint subpatches_high;
  uint bvh_low;
  uint bvh_high;
  uint boxes_low;  // of the device's own structure over the parts' boxes
  uint boxes_high;
  float scene_radius;  // no part is farther from the scene's origin
  uint padding0;
  uint padding1;
  uint padding2;
};

// One frame's constants. Rays leave the eye; near(x, y) = eye + ray_corner + x ray_dx + y ray_dy is
// the point of the near plane seen through image position (x, y) in pixels, y down, (0, 0) the top
// left corner.
struct TraceParams {
  vec4 eye;  // xyz: position of the eye; w: distance of the far plane over that of the near plane
  vec4 ray_corner;  // xyz
  vec4 ray_dx;      // xyz
  vec4 ray_dy;      // xyz
  // The same rays in the camera's frame, whose third axis is the camera's and whose origin, the
  // anchor, lies on it near the scene's centre, so that an eye far away costs no digits: at depth z
  // in it, x and y are those of the ray at depth 0 times 1 + z / anchor.w.
  vec4 anchor;   // xyz: the anchor, from the scene's origin; w: its distance from the eye
  vec4 frame_x;  // xyz: unit vector to the right; w: a pixel's width at depth 0
  vec4 frame_y;  // xyz: unit vector down; w: a pixel's height at depth 0
  vec4 frame_z;  // xyz: unit vector ahead; w: depth of the near plane
  vec4 light;    // xyz: unit vector toward the light
  vec4 grid;     // xyz: origin of the shading grid; w: 1 / its cell size
  uint width;    // image size in pixels
  uint height;
  uint triangle_count;
  uint rank;         // bisection: rank - 1 halvings
  float alpha;       // Phong Tessellation: 0 flat, 1 full projection
  float resolution;  // bisection: 2^-rank, the acceptance tolerance over the chord's length
  float min_delta;   // bisection: smallest acceptance tolerance, world units
  uint subpatch_count;
};

// A kernel ends a ray's walk through the list after so many steps, through or not, and queues what
// is left of it for the next submit: a device may not be kept too long, and llvmpipe ends all loops
// of a subgroup after 65535 iterations without saying so.
struct PausedRay {
  vec4 hit;  // the nearest root so far: xyz: weights; w: its place along the ray
  uint triangle;
  uint subpatch;  // of the hit
  uint ray;       // pixel of the image in raster order, or index of a cast ray
  uint item;      // of the list or entry of the tree, with which it goes on
  uint path;      // in a part, the node with which it goes on
  uint evaluations;
  uint candidates;
  uint padding;
};

// What a submit leaves behind.
struct QueueState {
  uint queued;     // rays that paused
  uint bytes_low;  // that rays have read of the scene, 64 bits, if work is counted
  uint bytes_high;
  uint padding;
};

// Bytes of the structures above and of an entry of the tree.
const uint TRIANGLE_BYTES = 192u;
const uint SUBPATCH_BYTES = 96u;
const uint BALL_BYTES = 16u;  // of either
const uint BVH_ENTRY_BYTES = 32u;

// What a submit goes on with.
struct QueuePush {
  uint pass;     // how many submits these rays have been through
  uint steps;    // after which a ray pauses
  uint resumed;  // so many paused rays, from the second pass on
  uint from;     // index of the first of them in the queue
  uint to;       // index in the queue for the first that pauses again
};

// What one submit of new rays covers: workgroups first_group, first_group + 1, ... in raster order,
// of an image of which the output buffers hold `rows` rows from first_row on.
struct TilePush {
  QueuePush queue;
  uint first_group;
  uint first_row;
  uint rows;
};

// How a window shows a frame of another size: each of its pixels is the mean of the frame's under
// it, or lies between the four next to it.
struct ScreenPush {
  uint width;  // of the window, in pixels
  uint height;
  uint frame_width;
  uint frame_height;
  uint shown;  // SHOWN_...
  float low;   // what the dark end of the scale stands for: depth; log10 of an error; evaluations
  float high;
  uint padding;
};

// Per-pixel outputs beside the colour.
struct PixelAovs {
  vec4
      normal_z;  // xyz: shading normal; w: distance from the eye along the unit ray, 0 where missed
  vec4 geometric_u;  // xyz: geometric normal; w: barycentric weight of vertex 1
  float v;           // barycentric weight of vertex 2
  uint triangle;     // index of the triangle, NO_TRIANGLE where missed
  uint evaluations;  // of a field or a surface, if counted
  uint candidates;   // parts or triangles whose ball the ray meets, if counted
};

// A ray of its own, not a pixel's: anchor + z direction, z at least `nearest`.
struct CastRay {
  vec4 anchor;     // xyz: a point of it; w: nearest
  vec4 direction;  // xyz: unit vector
};

// What a cast ray meets first.
struct CastHit {
  float z;
  float u;  // weights of vertices 1 and 2
  float v;
  uint triangle;  // NO_TRIANGLE if nothing; the other members are 0 then
  uint evaluations;
  uint candidates;
  uint padding0;
  uint padding1;
};

// Which rays of a buffer a submit of new rays covers.
struct CastPush {
  QueuePush queue;
  uint first;
  uint end;
};

const uint NO_TRIANGLE = 4294967295u;

// More than any cosine.
const float NO_CONE = 2.0;
// SubpatchBounds::bend of a part with a kink.
const float NONSMOOTH = -1.0;
// A node is searched with so much of its size around it: no root is lost on the border of two
// nodes.
const float OVERLAP = 0.03125;
// A part is enlarged by so much for its cone.
const float CONE_MARGIN = 0.125;

// Boxes are widened by this part of the scene's extent when the tree is built, and of the distance
// of a ray's anchor when it is met: some roundings of a position, and what the solver calls a
// touch.
const float BVH_SLACK = 0.00000095367431640625;  // 2^-20
// The tree's depth, and nodes that a packet's stack can number.
const int BVH_LEVELS = 32;
const uint BVH_MOST_NODES = 16777216u;
const uint BVH_EMPTY = 0u;
const uint BVH_LEAF = 2147483648u;
const uint BVH_END = 4294967295u;

// Surfaces: how far a point of the base triangle is displaced.
const uint SURFACE_FLAT = 0u;
const uint SURFACE_PHONG = 1u;
const uint SURFACE_SPHERE = 2u;

// Shells: along which direction. surface.glsl says what they are.
const uint SHELL_HEIGHT = 0u;
const uint SHELL_NORMAL = 1u;

// Solvers: how a root is found.
const uint SOLVER_BISECT = 0u;
const uint SOLVER_ROBUST = 1u;

// What of a frame is shown.
const uint SHOWN_COLOR = 0u;
const uint SHOWN_NORMAL = 1u;     // of shading
const uint SHOWN_GEOMETRIC = 2u;  // normal
const uint SHOWN_DEPTH = 3u;
const uint SHOWN_PATCH = 4u;
const uint SHOWN_UV = 5u;
const uint SHOWN_EVALUATIONS = 6u;
// The colours' x is an error, or one of these.
const uint SHOWN_ERROR = 7u;
const float ERROR_NOTHING = -1.0;  // nothing is there
const float ERROR_UNDECIDED = -2.0;
const float ERROR_WRONG = -3.0;  // hit, and should not be, or the other way round

// Workgroups are TILE_SIZE x TILE_SIZE pixels.
#define TILE_SIZE 8
// A tile's list holds so many parts. The rays of one that more parts touch go through all of them.
#define TILE_CAPACITY 64
// Invocations of a workgroup that each see to one part; rows of tiles that one of them looks at.
#define SUBPATCH_GROUP_SIZE 64
#define BIN_ROWS 16
// Rays that a workgroup casts.
#define CAST_SIZE 64

// Descriptor bindings, set 0.
#define BINDING_PARAMS 0
#define BINDING_TRIANGLES 1
#define BINDING_COLOR 2
#define BINDING_AOVS 3
#define BINDING_SUBPATCHES 4
#define BINDING_RAYS 5
#define BINDING_HITS 6
#define BINDING_QUEUE 7
#define BINDING_QUEUED 8
#define BINDING_PUSH 9  // OpenGL only
#define BINDING_PROJECTED 10
#define BINDING_TILE_COUNTS 11
#define BINDING_TILE_SUBPATCHES 12
#define BINDING_TILE_ORDER 13
#define BINDING_TILES_SEEN 14
#define BINDING_BVH 15
#define BINDING_ADDRESSES 16
#define BINDING_FRAME 17  // a texture

// Specialisation constants.
#define CONSTANT_SURFACE 0
#define CONSTANT_AOVS 1
#define CONSTANT_SHELL 2
#define CONSTANT_SOLVER 3
#define CONSTANT_COUNTS 4
#define CONSTANT_DIVIDED 5
#define CONSTANT_SHADOWS 6
#define CONSTANT_BALLS 7
#define CONSTANT_NONSMOOTH 8
