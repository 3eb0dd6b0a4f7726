// Several rays a pixel: a frame of more pixels, averaged.
#pragma once

#include <cstdint>

#include "app/frame/frame.h"

namespace trisect {

// Rays of a pixel in a row, of so many in all, a square number.
uint32_t samples_across(uint32_t spp);

// The frame with blocks of across x across pixels made one: its colour is their mean in linear
// light, its w the part of them that hit something; its evaluations and candidates are their sum.
// The other AOVs are those of the block's pixel in the middle, the lower right one of four.
Frame averaged(Frame samples, uint32_t across);

}  // namespace trisect
