// The types of the surface mathematics.

// What displaces a triangle; surface.glsl says how.
struct Shape {
  uint surface;
  uint shell;
  real alpha;  // phong only
};

// sigma, the displacement in units of the shell's direction, and its derivatives.
struct Displacement {
  real s;
  real u;
  real v;
};

// How a height s over the base point T along D changes with them: ds = along_T . dT + along_D . dD.
struct Gradient {
  vec3 along_T;
  vec3 along_D;
};
