// What C++ and GLSL share: buffer layouts, binding numbers, constants. Declared here, once.
//
// This file is included by the shaders and, through app/surface/shared.h, by C++, inside a
// namespace in which vec4 and uint are GLM's. There is no include guard because it is included once
// for each scalar type, each time into a namespace of its own. Only vec4 and 4-byte scalars in
// groups of four appear, so std140, std430 and C++ agree on every offset;
// tests/buffers/layout_test.cpp checks that against the compiled SPIR-V.

// A baked triangle, 192 bytes: the structure of the thesis, member for member.
struct Triangle {
  vec4 Position[3];    // xyz: vertex; w of the three: red, green and blue of the triangle, negative
                       // if it has no colour of its own
  vec4 Normal[3];      // xyz: unit vertex normal
  vec4 TriNormal;      // xyz: unit face normal n; w: length of the longest edge
  vec4 NormDot;        // component i: dot(Normal[i], n), but no nearer to 0 than LEAST_COSINE
  vec4 Domain;         // xyz, w: centre and radius of a ball that contains the displaced patch;
                       // a negative radius: there is no displaced patch
  vec4 VertexData[3];  // at vertex i: x, y: curvature toward its lower- and higher-numbered
                       // neighbour; z: interior angle in radians
};

// The bounds of a subpatch, 96 bytes: a sub-triangle of a displaced triangle, the weights
// w = sub_triangle.xyz + sub_triangle.w l of the patch for weights l within it. There sigma is
// close to the quadratic q with the Bernstein coefficients corner and edge, and S to T + q D. The
// errors hold for the sub-triangle enlarged by OVERLAP.
struct SubpatchBounds {
  vec4 ball;          // xyz, w: centre and radius of a ball that contains the surface
  vec4 sub_triangle;  // xyz: origin; w: size, 1 for the whole, negative if it is upside down
  vec4 corner;        // xyz: q_00, q_11, q_22; w: position error: S is no farther from T + q D
  vec4 edge;          // xyz: q_01, q_12, q_02; w: tangent error: S_u, S_v no farther from T + q D's
  // No line along a unit vector d with |dot(d, cone.xyz)| > cone.w, cone.xyz a unit vector too,
  // meets the subpatch, enlarged by CONE_MARGIN, twice. w is NO_CONE if there is no such d.
  vec4 cone;
  uint triangle;             // index
  uint is_flat;              // 1: sigma is 0
  float gradient_lipschitz;  // Lipschitz constant of the gradient of sigma - q in the weights 1 and
                             // 2, times |D|; NONSMOOTH if the gradient may jump
  // Not 0: a patch or subpatch that is divided, of which only the ball is used. So many bounds
  // follow, of all that it is divided into; their surfaces lie in its ball.
  uint skip;
};

// A node of the bounding volume hierarchy over the subpatches' boxes, 128 bytes. The boxes of its
// eight children are on a grid of 1024 planes along each axis, of which plane q is at origin + q
// step (Ylitie, Karras & Laine 2017, "Efficient incoherent ray traversal on GPUs through compressed
// wide BVHs", section 3.1, with bytes). The children are in the order of octants: bit k of a
// child's number is set if it lies on the far side along axis k.
//
// An item of a traversal is BVH_PLACES times the node's number plus a place, 0 to 8, in the order
// in which the ray meets the children.
struct BvhNode {
  float origin_x;
  float origin_y;
  float origin_z;
  uint parent;  // the item of the parent of which this node is the child; BVH_END for the root
  float step_x;
  float step_y;
  float step_z;
  uint children;   // bit k: there is a child k
  uvec2 boxes[8];  // x: the planes of the least corner, BVH_PLANE_BITS for each axis; y: of the
                   // largest
  uint links[8];   // of each child: its node's first item, or BVH_LEAF + index of a subpatch
};

// What a frame's camera sees of a subpatch, 192 bytes, written anew for every frame. Image
// positions are in pixels, y down, (0, 0) the top left corner.
struct ProjectedSubpatch {
  // The subpatch is seen within the box, and on the inner side of three lines: an image position p
  // is outside if lines_x[i] p.x + lines_y[i] p.y > lines_at[i].
  vec4 box;      // least x, least y, largest x, largest y
  vec4 lines_x;  // xyz; w: the depth in the camera's frame at which the subpatch begins
  vec3 lines_y;
  uint triangle;  // index
  vec4 lines_at;  // xyz; w: SubpatchBounds::corner.x
  // The patch in the axes of the camera's frame.
  vec4 P0;  // xyz: vertex; w: SubpatchBounds::edge.x
  vec4 P1;
  vec4 P2;
  vec4 D0;  // xyz: the shell's direction; w: SubpatchBounds::sub_triangle.x
  vec4 D1;
  vec4 D2;
  vec4 cone;  // SubpatchBounds::cone
  // x: SubpatchBounds::sub_triangle.w; y: position_tolerance of the ray along the axis; zw:
  // SubpatchBounds::corner.yz
  vec4 sizes;
};

// The list of the subpatches whose projections overlap a tile, among those of all tiles.
struct TileList {
  uint count;  // of the subpatches
  uint end;    // index of the first entry after the list's; NOT_LISTED: there is no list, for the
               // tile has more than TILE_CAPACITY subpatches, or there is no room for them
};

// What the lists of a band of the image add up to.
struct TileTotals {
  uint tiles;    // with a subpatch
  uint entries;  // of all lists of at most TILE_CAPACITY subpatches
  uint padding0;
  uint padding1;
};

// The device addresses, low and high half, of buffers that kernels reach by them.
struct Addresses {
  uint triangles_low;
  uint triangles_high;
  uint subpatches_low;
  uint subpatches_high;
  uint bvh_low;
  uint bvh_high;
  uint boxes_low;  // of the device's own acceleration structure over the subpatches' boxes
  uint boxes_high;
  uint projected_low;  // of the ProjectedSubpatches of a frame
  uint projected_high;
  float scene_radius;  // no box reaches farther from the scene's origin
  uint padding;
};

// One frame's constants. Rays leave the eye; near(x, y) = eye + ray_corner + x ray_dx + y ray_dy is
// the point of the near plane seen through image position (x, y) in pixels, y down, (0, 0) the top
// left corner.
struct TraceParams {
  vec4 eye;  // xyz: position of the eye; w: distance of the far plane over that of the near plane
  vec4 ray_corner;  // xyz
  vec4 ray_dx;      // xyz
  vec4 ray_dy;      // xyz
  // The same rays in the camera's frame: its third axis points ahead, its origin, the anchor, lies
  // on the line of sight near the scene's centre, so that coordinates keep their digits even if the
  // eye is far away. At depth z a ray's x and y are those at depth 0 times 1 + z / anchor.w.
  vec4 anchor;   // xyz: the anchor, from the scene's origin; w: its distance from the eye
  vec4 frame_x;  // xyz: unit vector to the right; w: a pixel's width at depth 0
  vec4 frame_y;  // xyz: unit vector down; w: a pixel's height at depth 0
  vec4 frame_z;  // xyz: unit vector ahead; w: depth of the near plane
  vec4 light;    // xyz: unit vector toward the light
  vec4 grid;     // xyz: origin of the shading grid; w: 1 / its cell size
  vec4 color;    // xyz: of the surface, sRGB-encoded, for SHADING_PLAIN and SHADING_GRID; w: 1: of
                 // triangles that have no colour of their own
  vec4 background;  // xyz: the colour where nothing is hit; w: 1: the sky instead
  uint width;       // size in pixels of what is traced: the image, or a part of it
  uint height;
  uint triangle_count;
  uint rank;         // bisection: rank - 1 halvings
  float alpha;       // Phong Tessellation: 0 flat, 1 full projection
  float resolution;  // bisection: 2^-rank, the acceptance tolerance over the chord's length
  float min_delta;   // bisection: smallest acceptance tolerance, world units
  uint subpatch_count;
  uint shading;      // SHADING_...
  float depth_low;   // SHADING_DEPTH: the distance from the eye that is white
  float depth_high;  // and that which is black
  // The top left pixel of what is traced in the image, and the image's size. Rays are the same
  // whether the image is traced whole or in parts, bit for bit.
  uint first_x;
  uint first_y;
  uint image_width;
  uint image_height;
  uint padding;
};

// Most subpatches that Newton's method may leave undecided for a ray before the ray has to go
// through all candidates again.
const uint MOST_PENDING = 8u;

// A ray whose traversal pauses after a number of steps, to go on in the next pass. No dispatch may
// take too long, or the driver takes the device for lost, and llvmpipe ends all loops of a subgroup
// after 65535 iterations without an error.
struct PausedRay {
  vec4 hit;       // the nearest root so far: xyz: weights; w: Hit::z
  uint triangle;  // of the hit
  uint subpatch;  // of the hit
  uint ray;       // pixel of the image in raster order, or index of a cast ray
  uint item;      // where it goes on: Traversal::item
  uint path;      // and Traversal::path
  uint evaluations;
  uint candidates;
  // If not 0, so many subpatches are all that is left to search, and `item` is not used.
  uint pending_count;
  uint pending[MOST_PENDING];  // the last one comes first
};

// Which rays a pass traces: new ones, or paused ones that go on.
struct QueuePass {
  uint pass;     // number of earlier passes of the same rays; from 1 on the rays are from the queue
  uint steps;    // after which a ray pauses
  uint resumed;  // number of rays that go on
  uint from;     // queue index of the first of them
  uint to;       // queue index for the first ray that pauses
};

// The state of the queue. A frame goes on by it without the host: begin_part.comp and
// next_pass.comp make of it the next pass, and the workgroups of the next dispatch.
struct QueueState {
  QueuePass now;
  uint queued;     // rays that have paused in this pass
  uint bytes_low;  // bytes of the scene that rays have read, low and high half, if work is counted
  uint bytes_high;
  uint all_queued;  // rays that have paused in all passes
  uint begun;       // parts of the submit that have begun
  uint is_held;     // 1: no other part begins, as rays are left or the tiles' lists do not fit
  uint groups_x;    // of the next dispatch
  uint groups_y;
  uint groups_z;
};

// Sizes of what rays read of the scene, for counting bytes.
const uint TRIANGLE_BYTES = 192u;
const uint SUBPATCH_BYTES = 96u;
const uint BALL_BYTES = 16u;  // Triangle::Domain or SubpatchBounds::ball
// Of a node, to test its children, to test one of them, and to see what it links to.
const uint BVH_TEST_BYTES = 96u;
const uint BVH_BOX_BYTES = 32u;
const uint BVH_LINK_BYTES = 4u;

// A part of an image's rays: workgroups (tiles) first_group, first_group + 1, ... in raster order.
// The output buffers hold `rows` rows of the image from first_row on.
struct TilePush {
  uint first_group;
  uint stride;  // from each run of workgroups to the one after it (workgroup_order.glsl)
  uint first_row;
  uint rows;
  // For begin_part.comp alone.
  uint groups;      // of the part
  uint listed;      // 1: they are numbers of tiles with a list, of which there may be fewer
  uint must_fit;    // 1: it does not begin if the tiles' lists do not fit into their buffer
  uint steps;       // after which a ray pauses
  uint half_queue;  // rays that a half of the queue holds
};

// How a window shows a frame. Where sizes differ, a pixel of the window has the mean of the frame's
// pixels under it if these are smaller, and interpolates between four of them if they are larger.
struct ScreenPush {
  uint width;  // of the window, in pixels
  uint height;
  uint frame_width;
  uint frame_height;
  uint shown;  // SHOWN_...
  float low;   // the value at the dark end of the scale: depth; log10 of an error; evaluations
  float high;  // the value at the other end
  uint padding;
};

// The outputs of a pixel beside its colour.
struct PixelAovs {
  vec4 normal_z;     // xyz: shading normal; w: distance from the eye along the ray, 0 where missed
  vec4 geometric_u;  // xyz: geometric normal; w: barycentric weight of vertex 1
  float v;           // barycentric weight of vertex 2
  uint triangle;     // index of the triangle, NO_TRIANGLE where missed
  uint evaluations;  // of a field or a surface, if counted
  uint candidates;   // subpatches or triangles whose bounds the ray meets, if counted
};

// A ray that is given, not a pixel's: anchor + z direction, z at least `nearest`.
struct CastRay {
  vec4 anchor;     // xyz: a point of the ray; w: nearest
  vec4 direction;  // xyz: unit vector
};

// The first hit of a cast ray.
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

// Which rays of a buffer are cast.
struct CastPush {
  uint first;
  uint end;
};

const uint NO_TRIANGLE = 4294967295u;
// TileList::end of a tile without a list.
const uint NOT_LISTED = 4294967295u;

// The coordinates, directions and displacements of a patch that the bake hands to the kernels add
// up to less: the square of such a number has room in single precision.
const float LARGEST = 1152921504606846976.0;  // 2^60

// In the height shell directions are divided by NormDot. With a normal closer to its face's plane
// than this, 0.014 degrees, there is no displaced patch: the direction's part along the face
// normal, which is 1, would have less than half of single precision's digits.
const float LEAST_COSINE = 0.000244140625;  // 2^-12

// What colour a surface has: lit; lit, with the thesis's grid; that of its shading normal, of the
// number of its triangle, of its distance.
const uint SHADING_PLAIN = 0u;
const uint SHADING_GRID = 1u;
const uint SHADING_NORMAL = 2u;
const uint SHADING_PATCH = 3u;
const uint SHADING_DEPTH = 4u;

// SubpatchBounds::cone.w without a cone: more than any cosine.
const float NO_CONE = 2.0;
// SubpatchBounds::gradient_lipschitz of a subpatch over which the gradient of sigma may jump.
const float NONSMOOTH = -1.0;
// A sub-triangle is searched with a margin of this part of its size along each side, so that no
// root is lost on the border between two.
const float OVERLAP = 0.03125;
// The same for a subpatch's cone.
const float CONE_MARGIN = 0.125;

// Boxes are widened by this part of the scene's radius when the tree is built, and by this part of
// the distance of a ray's anchor when a ray is tested: more than the solver's tolerance, by which a
// root may lie beside the surface, and than the roundings of a position or of a node's plane.
const float BVH_SLACK = 0.00000095367431640625;  // 2^-20
// Most levels of the tree, and most nodes, as a packet's stack has 24 bits for a node's number.
const int BVH_LEVELS = 32;
const uint BVH_MOST_NODES = 16777216u;
const uint BVH_CHILDREN = 8u;  // of a node at most
const uint BVH_PLACES = 16u;
const uint BVH_PLANE_BITS = 10u;
// Values of BvhNode::links and parent.
const uint BVH_LEAF = 2147483648u;
const uint BVH_END = 4294967295u;

// Surfaces: how far a point of the base triangle is displaced (surface.glsl).
const uint SURFACE_FLAT = 0u;
const uint SURFACE_PHONG = 1u;
const uint SURFACE_SPHERE = 2u;

// Shells: along which direction.
const uint SHELL_HEIGHT = 0u;
const uint SHELL_NORMAL = 1u;

// Solvers: how a root is found.
const uint SOLVER_BISECT = 0u;
const uint SOLVER_ROBUST = 1u;

// Which output of a frame a window shows.
const uint SHOWN_COLOR = 0u;
const uint SHOWN_NORMAL = 1u;     // shading normal
const uint SHOWN_GEOMETRIC = 2u;  // geometric normal
const uint SHOWN_DEPTH = 3u;
const uint SHOWN_PATCH = 4u;
const uint SHOWN_UV = 5u;
const uint SHOWN_EVALUATIONS = 6u;
// In place of the colours there are errors; x is one, or one of these.
const uint SHOWN_ERROR = 7u;
const float ERROR_NOTHING = -1.0;    // a miss, as it should be
const float ERROR_UNDECIDED = -2.0;  // the reference cannot tell
const float ERROR_WRONG = -3.0;      // a hit instead of a miss, or the other way round

// How a window gets the colour of a pixel from the frame.
const uint SCREEN_PIXEL = 0u;     // that of the same pixel: they have the same size
const uint SCREEN_ENLARGED = 1u;  // interpolated between pixels
const uint SCREEN_MEAN = 2u;      // the mean of several pixels
const uint SCREEN_OUTPUT = 3u;    // from an output other than SHOWN_COLOR
#define SCREEN_WAYS 4

// Workgroups are TILE_SIZE x TILE_SIZE pixels.
#define TILE_SIZE 8
// Most subpatches of a tile's list. The rays of a tile with more go through all subpatches. The
// entries of all lists have 32-bit indices: a band of an image has at most 2^22 tiles, for its
// colours lie in a buffer of at most 2^32 bytes.
#define TILE_CAPACITY 1024
// Subpatches that a workgroup projects or enters into lists, one for each invocation.
#define SUBPATCH_GROUP_SIZE 64
// Cast rays of a workgroup.
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
#define BINDING_TILE_LISTS 11
#define BINDING_TILE_SUBPATCHES 12
#define BINDING_TILE_ORDER 13
#define BINDING_TILE_TOTALS 14
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
#define CONSTANT_EIGHT_LANES 9
#define CONSTANT_FILLS 10
#define CONSTANT_SCREEN 11
