// What the program does with one input of each kind that it is given by others: for the fuzzers,
// and for the test of the inputs that were findings once.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>

namespace trisect::fuzz {

using Bytes = std::span<const uint8_t>;

// An answer that is neither right nor an error of app/base/error.h.
class Finding : public std::logic_error {
  using std::logic_error::logic_error;
};

// These return where the answer is right, InputError and UsageError among the right ones. Whatever
// they throw is a finding.

// A model file. The first byte picks the ending of its name, the options of the mesh and the
// surface for which its first triangles are baked.
void model_input(Bytes input);

// The keyframes of a camera, as JSON, and the cameras between them.
void path_input(Bytes input);

// One or two pictures, PNG or EXR: their pixels, what they say of themselves, and the stitched one.
// The first byte picks the format and says whether there are two; the next two are then the length
// of the first picture.
void picture_input(Bytes input);

// A command line, the viewer's flags, its script, or the value of an option. The first byte picks
// which.
void text_input(Bytes input);

// Floating-point numbers for the solvers on the CPU. The first byte picks the surface and says
// whether the numbers are a triangle, which is baked, and a ray, or overwrite numbers of a scene
// that is baked already, its parameters and its ray.
void solver_input(Bytes input);

}  // namespace trisect::fuzz
