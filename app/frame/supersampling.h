// Several rays for each pixel: a larger frame is traced and averaged.
#pragma once

#include <cstdint>

#include "app/frame/frame.h"

namespace trisect {

// Rays in a row of a pixel that has spp rays in all; spp is a square number.
uint32_t samples_across(uint32_t spp);

// The frame with each block of across x across pixels made one pixel. Its colour is the mean of the
// block in linear light, its w the share of the block's rays that hit something, its evaluations
// and candidates their sum. The other outputs, of which a mean would mean nothing, are those of the
// block's middle pixel (the lower right one of the four in the middle, if the block is even).
// width and height must be multiples of `across`.
Frame averaged(Frame samples, uint32_t across);

}  // namespace trisect
