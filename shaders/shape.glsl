// The types of the surface mathematics, for the kernels and for C++ in single and in double precision.

// Which surface displaces the base triangle, along which directions: SURFACE_... and SHELL_... of shared.h.
// surface.glsl has the formulas.
struct Shape {
  uint surface;
  uint shell;
  real alpha;  // Phong Tessellation only
};

// The displacement sigma, in units of the shell's direction D, and its derivatives by the weights 1 and 2, the weight 0
// giving way: u goes toward vertex 1, v toward vertex 2.
struct Displacement {
  real s;
  real u;
  real v;
};

// The gradient of the height s above the base point T along D: ds = along_T . dT + along_D . dD.
struct Gradient {
  vec3 along_T;
  vec3 along_D;
};

// A patch's vertices P and the shell's directions D at them, in some frame of coordinates: the scene's or a ray's.
struct FramedPatch {
  vec3 P0;
  vec3 P1;
  vec3 P2;
  vec3 D0;
  vec3 D1;
  vec3 D2;
};

// A sub-triangle of a patch: the point with weights l within it has the weights w = origin + size l of the patch.
// origin.x + origin.y + origin.z = 1 - size. A negative size turns the triangle upside down, as the middle one of four
// children is.
struct SubTriangle {
  vec3 origin;
  real size;
};
