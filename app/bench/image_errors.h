// How different two pictures look.
#pragma once

#include "app/frame/frame.h"

namespace trisect::bench {

// The mean over all pixels of Wang, Bovik, Sheikh and Simoncelli's structural similarity ("Image
// quality assessment", 2004, equation 13): 1 if the frames are equal. Of the luma of sRGB-encoded
// colours (Rec. 709), with a Gaussian window of 11 x 11 pixels of deviation 1.5, K1 = 0.01 and
// K2 = 0.03, as there; at the borders with the part of the window that is within. Both frames have
// the same size.
double structural_similarity(const Frame& a, const Frame& b);

// The mean of (frame - truth)^2 / (truth^2 + 0.01) over all components in linear light: the
// relative mean square error, after Rousselle, Knaus and Zwicker ("Adaptive sampling and
// reconstruction using greedy error minimization", 2011).
double relative_square_error(const Frame& frame, const Frame& truth);

}  // namespace trisect::bench
