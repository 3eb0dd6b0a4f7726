#include "app/picture/image_channels.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "app/base/error.h"
#include "app/frame/frame.h"
#include "app/picture/exr_pixels.h"
#include "app/picture/image_reader.h"
#include "app/picture/open_exr.h"
#include "app/picture/png_pixels.h"
#include "app/picture/stitch.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

bool is_exr(const fs::path& path) {
  return image_format(path) == ImageFormat::exr;
}

// R, G, B, A of a PNG: 0 to 3.
constexpr const char* kPngNames = "RGBA";

std::vector<uint32_t> exr_bits(const fs::path& path, Imf::InputFile& file,
                               const std::string& name) {
  const Imf::Channel& channel = file.header().channels()[name.c_str()];
  if (channel.xSampling != 1 || channel.ySampling != 1) {
    throw InputError(
        fmt::format("{}: channel {} has not a number for every pixel.", path.string(), name));
  }
  const Imath::Box2i& window = file.header().dataWindow();
  const auto size = [](int64_t first, int64_t last) {
    return static_cast<std::size_t>(last - first + 1);
  };
  const std::size_t width = size(window.min.x, window.max.x);
  const std::size_t height = size(window.min.y, window.max.y);
  expect_pixels(width, height, sizeof(uint32_t), path.string());
  std::vector<uint32_t> bits(width * height);
  const Imf::PixelType type = channel.type == Imf::UINT ? Imf::UINT : Imf::FLOAT;
  Imf::FrameBuffer buffer;
  buffer.insert(name, Imf::Slice::Make(type, bits.data(), window, sizeof(uint32_t),
                                       sizeof(uint32_t) * width));
  read_known_pixels(file, buffer);
  return bits;
}

}  // namespace

std::string window_text(const std::optional<ImageWindow>& window) {
  if (!window) return "a whole image";
  return fmt::format("at {},{} in an image of {}x{}", window->x, window->y, window->width,
                     window->height);
}

std::optional<ImageWindow> read_window(const fs::path& path) {
  if (!is_exr(path)) {
    const std::optional<FramePlace> place = place_in(read_attributes(path));
    if (!place) return std::nullopt;
    return ImageWindow{place->x, place->y, place->image_width, place->image_height};
  }
  return with_exr(path, [](const Imf::InputFile& file) -> std::optional<ImageWindow> {
    const Imath::Box2i& all = file.header().displayWindow();
    const Imath::Box2i& part = file.header().dataWindow();
    if (all == part) return std::nullopt;
    const auto size = [](int first, int last) { return int64_t{last} - first + 1; };
    return ImageWindow{int64_t{part.min.x} - all.min.x, int64_t{part.min.y} - all.min.y,
                       size(all.min.x, all.max.x), size(all.min.y, all.max.y)};
  });
}

ImageChannels::ImageChannels(const fs::path& path) : path_(path) {
  if (is_exr(path)) {
    with_exr(path, [&](const Imf::InputFile& file) {
      const Imf::ChannelList& channels = file.header().channels();
      for (auto at = channels.begin(); at != channels.end(); ++at) names_.emplace_back(at.name());
      expect_whole_blocks(file);
    });
  } else {
    png_ = std::make_unique<const PngValues>(read_png_values(path));
    const std::size_t count = png_->alpha ? 4 : 3;
    for (std::size_t k = 0; k < count; ++k) names_.emplace_back(1, kPngNames[k]);
  }
  std::sort(names_.begin(), names_.end());
}

ImageChannels::~ImageChannels() = default;

std::vector<uint32_t> ImageChannels::bits(const std::string& name) const {
  if (!png_) {
    return with_exr(path_, [&](Imf::InputFile& file) { return exr_bits(path_, file, name); });
  }
  const std::size_t components = png_->alpha ? 4 : 3;
  std::vector<uint32_t> bits;
  bits.reserve(png_->values.size() / components);
  for (std::size_t i = std::string(kPngNames).find(name); i < png_->values.size();
       i += components) {
    bits.push_back(png_->values[i]);
  }
  return bits;
}

}  // namespace trisect
