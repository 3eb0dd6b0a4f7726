// The transfer function of sRGB (IEC 61966-2-1).
#pragma once

namespace trisect {

// One sRGB-encoded component as linear light.
float linear_from_srgb(float encoded);

// And back.
float srgb_from_linear(float linear);

}  // namespace trisect
