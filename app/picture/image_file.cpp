#include "app/picture/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>

#include "app/base/error.h"
#include "app/base/number_text.h"

namespace trisect {

ImageFormat image_format(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".png") return ImageFormat::png;
  if (ending == ".exr") return ImageFormat::exr;
  if (ending == ".pfm") return ImageFormat::pfm;
  throw UsageError(path.string() + ": an image's name must end in .png, .exr or .pfm.");
}

std::string value_text(const ImageValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* whole = std::get_if<int>(&value)) return std::to_string(*whole);
  if (const auto* number = std::get_if<double>(&value)) return number_text(*number);
  const auto& vector = std::get<glm::dvec3>(value);
  return fmt::format("{},{},{}", vector.x, vector.y, vector.z);
}

ImageTexts texts_of(const std::vector<ImageAttribute>& attributes) {
  ImageTexts texts;
  for (const ImageAttribute& attribute : attributes) {
    texts.emplace_back(attribute.name, value_text(attribute.value));
  }
  return texts;
}

void write_image(const Frame& frame, ImageFormat format, const AtomicFile& file,
                 const ImageContents& contents) {
  switch (format) {
    case ImageFormat::png:
      write_png(frame, file, contents);
      break;
    case ImageFormat::exr:
      write_exr(frame, file, contents);
      break;
    case ImageFormat::pfm:
      write_pfm(frame, file, contents);
      break;
  }
}

void save_image(const Frame& frame, const std::filesystem::path& path,
                const ImageContents& contents) {
  const ImageFormat format = image_format(path);
  AtomicFile file(path);
  write_image(frame, format, file, contents);
  file.commit();
}

}  // namespace trisect
