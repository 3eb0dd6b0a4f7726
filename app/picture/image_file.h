// Frames as image files. Safe to use from several threads.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <variant>
#include <vector>

#include "app/base/atomic_file.h"
#include "app/frame/frame.h"

namespace trisect {

enum class ImageFormat { png, exr };

// What a file says of its picture: an attribute of an EXR file's header.
struct ImageAttribute {
  std::string name;
  std::variant<std::string, int, double, glm::dvec3> value;
};

// By the file name's ending, .png or .exr in any letter case. Throws UsageError for any other.
ImageFormat image_format(const std::filesystem::path& path);

// Writes 8-bit sRGB. alpha: also A, and the colours that its pixels' parts with a hit have, where
// the others are black (Background::none). Throws InputError, naming the file.
void write_png(const Frame& frame, const AtomicFile& file, bool alpha = false);

// Writes R G B A (linear light, A = 1 where hit) and, if the frame has AOVs, Z, N.X N.Y N.Z, G.X
// G.Y G.Z, patch, U, V, in single precision, patch as unsigned integers; with evals also evals,
// unsigned. README says what each channel holds. Throws InputError, naming the file.
void write_exr(const Frame& frame, bool evals, const AtomicFile& file,
               const std::vector<ImageAttribute>& attributes = {});

// What of a frame a file has besides what each has.
struct ImageContents {
  bool evals = false;                      // EXR: a channel with the evaluations of each pixel
  bool alpha = false;                      // PNG: A, which EXR has always
  std::vector<ImageAttribute> attributes;  // EXR
};

// Writes in that format.
void write_image(const Frame& frame, ImageFormat format, const AtomicFile& file,
                 const ImageContents& contents = {});

// The same, by the file name's ending: the file appears whole or not at all. Throws UsageError or
// InputError.
void save_image(const Frame& frame, const std::filesystem::path& path, bool evals = false);

}  // namespace trisect
