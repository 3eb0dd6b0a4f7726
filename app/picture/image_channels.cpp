#include "app/picture/image_channels.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <exception>

#include "app/base/error.h"
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

// use(file) of an EXR, with what OpenEXR throws as InputError.
template <typename Use>
auto with_exr(const fs::path& path, const Use& use) {
  try {
    Imf::InputFile file = open_exr(path);
    return use(file);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{}: could not be read: {}.", path.string(), error.what()));
  }
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
  const auto width = static_cast<std::ptrdiff_t>(window.max.x) - window.min.x + 1;
  const auto height = static_cast<std::ptrdiff_t>(window.max.y) - window.min.y + 1;
  std::vector<uint32_t> bits(static_cast<std::size_t>(width * height));
  constexpr std::size_t bytes = sizeof(uint32_t);
  char* base = reinterpret_cast<char*>(bits.data()) -
               (window.min.x + window.min.y * width) * static_cast<std::ptrdiff_t>(bytes);
  const Imf::PixelType type = channel.type == Imf::UINT ? Imf::UINT : Imf::FLOAT;
  Imf::FrameBuffer buffer;
  buffer.insert(name, Imf::Slice(type, base, bytes, bytes * static_cast<std::size_t>(width)));
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
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

std::vector<std::string> channel_names(const fs::path& path) {
  std::vector<std::string> names;
  if (is_exr(path)) {
    names = with_exr(path, [](const Imf::InputFile& file) {
      std::vector<std::string> found;
      const Imf::ChannelList& channels = file.header().channels();
      for (auto at = channels.begin(); at != channels.end(); ++at) found.emplace_back(at.name());
      return found;
    });
  } else {
    const std::size_t count = read_png_values(path).alpha ? 4 : 3;
    for (std::size_t k = 0; k < count; ++k) names.emplace_back(1, kPngNames[k]);
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<uint32_t> channel_bits(const fs::path& path, const std::string& name) {
  if (is_exr(path)) {
    return with_exr(path, [&](Imf::InputFile& file) { return exr_bits(path, file, name); });
  }
  const PngValues png = read_png_values(path);
  const std::size_t components = png.alpha ? 4 : 3;
  std::vector<uint32_t> bits;
  bits.reserve(png.values.size() / components);
  for (std::size_t i = std::string(kPngNames).find(name); i < png.values.size(); i += components) {
    bits.push_back(png.values[i]);
  }
  return bits;
}

}  // namespace trisect
