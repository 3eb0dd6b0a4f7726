// The cubic Bezier triangle T + q D over a sub-triangle of a patch: T(w) = w_0 P0 + w_1 P1 + w_2 P2 and D(w) alike are
// linear in the weights, q is a quadratic. Farin, "Curves and Surfaces for CAGD", has the Bernstein form and blossoms.

// The blossom (polar form) at weights a, b of the patch of the quadratic with Bernstein coefficients
// corner = (q_00, q_11, q_22) and edge = (q_01, q_12, q_02): symmetric, affine in a and in b, and q(w) = blossom(w, w).
// Its values at pairs of a sub-triangle's corners are the coefficients over that.
real blossom(vec3 corner, vec3 edge, vec3 a, vec3 b) {
  EXACT real q = corner.x * a.x * b.x + corner.y * a.y * b.y + corner.z * a.z * b.z +
                 edge.x * (a.x * b.y + a.y * b.x) + edge.y * (a.y * b.z + a.z * b.y) +
                 edge.z * (a.x * b.z + a.z * b.x);
  return q;
}

// As a ray sees it, along the third axis of its frame.
#define POINT vec2
#define NET ControlNet
#define CONTROL_NET control_net
#define TANGENTS Tangents
#include "control_net_of_points.glsl"
#undef POINT
#undef NET
#undef CONTROL_NET
#undef TANGENTS

// In three dimensions.
#define POINT vec3
#define NET ControlNet3D
#define CONTROL_NET control_net_3d
#define TANGENTS Tangents3D
#include "control_net_of_points.glsl"
#undef POINT
#undef NET
#undef CONTROL_NET
#undef TANGENTS
