// Frames as image files. Safe to use from several threads.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/base/atomic_file.h"
#include "app/frame/frame.h"
#include "app/frame/image_part.h"

namespace trisect {

enum class ImageFormat { png, exr, pfm };

using ImageValue = std::variant<std::string, int, double, glm::dvec3>;

// What a file says of its picture: an attribute of an EXR file's header, a text of a PNG file.
struct ImageAttribute {
  std::string name;
  ImageValue value;
};

// The names and values of attributes, as value_text() has them.
using ImageTexts = std::vector<std::pair<std::string, std::string>>;

// The outputs of a pixel, as --aov and the channels of EXR files name them. docs/images.md says
// what each holds.
enum class Aov {
  color,      // R G B A
  depth,      // Z
  normal,     // N.X N.Y N.Z
  geometric,  // G.X G.Y G.Z
  patch,      // patch
  uv,         // U V
  position,   // P.X P.Y P.Z
  evals       // evals
};

// What of a frame a file has. Files are written row by row: beside the frame they take no memory
// that grows with its height.
struct ImageContents {
  // EXR: which channels. Those that the frame has not are left out. PFM: the first one.
  std::vector<Aov> aovs{Aov::color, Aov::depth, Aov::normal, Aov::geometric, Aov::patch, Aov::uv};
  // Of the hit of a pixel (x, y), for Aov::position.
  std::function<glm::vec3(uint32_t x, uint32_t y)> position;
  bool alpha = false;                      // PNG: A, which EXR has always
  std::optional<FramePlace> place;         // EXR and PNG, of a part of an image
  std::vector<ImageAttribute> attributes;  // EXR and PNG
};

// By the file name's ending, .png, .exr or .pfm in any letter case. Throws UsageError for any
// other.
ImageFormat image_format(const std::filesystem::path& path);

// As text; numbers are as short as they can be to be read back the same.
std::string value_text(const ImageValue& value);

ImageTexts texts_of(const std::vector<ImageAttribute>& attributes);

// Writes 8-bit sRGB, a part of an image with its offset (oFFs). With alpha the colours are those
// that its pixels' parts with a hit have, where the others are black (Background::none). Throws
// InputError, naming the file.
void write_png(const Frame& frame, const AtomicFile& file, const ImageContents& contents = {});

// Writes channels in single precision, patch and evals as unsigned integers, colours in linear
// light; a part of an image is the data window in the image's display window. Throws InputError,
// naming the file.
void write_exr(const Frame& frame, const AtomicFile& file, const ImageContents& contents = {});

// Writes three numbers a pixel, or one for Aov::depth: colours in linear light. Throws InputError,
// naming the file.
void write_pfm(const Frame& frame, const AtomicFile& file, const ImageContents& contents = {});

// Writes in that format.
void write_image(const Frame& frame, ImageFormat format, const AtomicFile& file,
                 const ImageContents& contents = {});

// The same, by the file name's ending: the file appears whole or not at all. Throws UsageError or
// InputError.
void save_image(const Frame& frame, const std::filesystem::path& path,
                const ImageContents& contents = {});

}  // namespace trisect
