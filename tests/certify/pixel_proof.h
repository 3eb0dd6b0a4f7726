// Whether certificates, each of which may be right, together prove what they are said to.
#pragma once

#include <string>
#include <vector>

#include "app/bake/bake.h"
#include "app/certify/certifier.h"

namespace trisect::test {

// What the certificates of an answer leave unproven, in words; empty if nothing:
// - of every patch whose ball comes near the tube they deal with every point;
// - each root lies inside its patch, or is another core's or before the rays begin, or lies on a
//   border behind the answer;
// - there is none before the answer's, of a miss none at all;
// - what is left out as lying behind lies behind the answer.
// The answer must be proven (is_proven). Sub-triangles are halves of halves: all sums are exact.
std::string gap_in(const std::vector<Certificate>& certificates, const CertifiedAnswer& answer,
                   const RayTube& tube, const std::vector<Triangle>& triangles);

}  // namespace trisect::test
