// Parts of an image put together.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/base/atomic_file.h"
#include "app/frame/image_part.h"
#include "app/picture/image_file.h"

namespace trisect {

// Writes the image of which the files are parts, all of them PNG or all of them EXR, with their
// pixels as they are, and what they say of themselves but for "tile". Where parts overlap the last
// one counts. Throws InputError, naming a file, if one cannot be read, does not say which part it
// is, or is of another image than the first one (made by whom and where does not count), and if a
// pixel is in none of them; UsageError if the formats are not all `format`.
void stitch(const std::vector<std::filesystem::path>& parts, ImageFormat format,
            const AtomicFile& file);

// Where a part with these attributes is in its image; nothing if they do not say it.
std::optional<FramePlace> place_in(const ImageTexts& attributes);

// Whether the file, PNG or EXR, can be read to its end.
bool is_whole_image(const std::filesystem::path& path);

// The name of what the two say differently of their pictures, "eye" or "model_sha256"; empty if
// there is nothing. Who made them on what, and where the model lies, does not count, nor, without
// counts of evaluations, the acceleration, on which no other output depends.
std::string difference_between(const ImageTexts& a, const ImageTexts& b);

}  // namespace trisect
