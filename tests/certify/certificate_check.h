// A second opinion on certificates, in numbers of fifty digits (MPFR). It shares nothing with what
// made them but the baked numbers: the surfaces are written once more, from their definitions.
#pragma once

#include "app/certify/certificate.h"
#include "app/surface/surface_choice.h"

namespace trisect::test {

enum class Opinion {
  proven,     // it holds: in exact arithmetic up to a rounding of fifty digits
  supported,  // nothing against it was found where it was tried
  unknown,    // Newton's method, which should have found the root, found nothing
  refuted
};

// What is tried:
// - hull, before and behind: 16 points must be on the side that is claimed. If the coordinates are
//   polynomials and all Bernstein coefficients are on it, too, that proves it.
// - no_root: none of 16 points may lie in the tube, and for the ray in the middle and the four at
//   the tube's edges Newton's method must find no root in the core.
// - one_root: for each of the five, Newton's method must find a root that lies, like its t, within
//   what is claimed; and from the piece's corners no other root in the piece.
//
// choice: with alpha as the kernels have it (with_single_alpha).
Opinion opinion_on(const Certificate& certificate, const RayTube& tube, const SurfaceChoice& choice,
                   const Triangle& tri);

// The surface that opinions are about, at the weights 1 and 2 of w.
glm::dvec3 point_in_fifty_digits(const SurfaceChoice& choice, const Triangle& tri,
                                 const glm::dvec3& w);

}  // namespace trisect::test
