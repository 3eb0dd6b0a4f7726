#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "app/base/srgb.h"
#include "app/picture/exr_output.h"
#include "app/picture/image_file.h"

namespace trisect {
namespace {

// The channels of a band of rows, each a component of an array of structures.
class Channels {
 public:
  // first: the pixel at which the band begins, in the image.
  Channels(std::size_t width, const Imath::V2i& first) : width_(width), first_(first) {}

  // pixel: the structure of the band's first pixel.
  template <typename Pixel>
  void add(const char* name, Imf::PixelType type, const Pixel* pixel, std::size_t offset) {
    // OpenEXR's slices are not const; writing a file only reads them.
    auto* base = reinterpret_cast<char*>(const_cast<Pixel*>(pixel)) + offset;
    // OpenEXR addresses pixels by their coordinates in the image.
    const auto size = static_cast<std::ptrdiff_t>(sizeof(Pixel));
    const std::ptrdiff_t row = size * static_cast<std::ptrdiff_t>(width_);
    base -= first_.x * size + first_.y * row;
    slices_.insert(name, Imf::Slice(type, base, sizeof(Pixel), static_cast<std::size_t>(row)));
  }

  [[nodiscard]] const Imf::FrameBuffer& slices() const { return slices_; }

 private:
  std::size_t width_;
  Imath::V2i first_;
  Imf::FrameBuffer slices_;
};

// What a file has of a frame, band by band.
class FrameRows {
 public:
  FrameRows(const Frame& frame, const ImageContents& contents, const Imath::V2i& first)
      : frame_(frame), contents_(contents), first_(first) {}

  // The slices point into this object and the frame.
  Imf::FrameBuffer band(uint32_t first, uint32_t count) {
    Channels channels(frame_.width, first_ + Imath::V2i(0, static_cast<int>(first)));
    if (has(Aov::color)) add_colors(first, count, channels);
    if (!frame_.aovs.empty()) add_aovs(frame_.aovs.data() + at(0, first), channels);
    if (has(Aov::position) && contents_.position) add_positions(first, count, channels);
    return channels.slices();
  }

 private:
  static constexpr std::size_t kComponent = sizeof(float);

  [[nodiscard]] bool has(Aov aov) const {
    return std::find(contents_.aovs.begin(), contents_.aovs.end(), aov) != contents_.aovs.end();
  }

  [[nodiscard]] std::size_t at(uint32_t x, uint32_t y) const {
    return std::size_t{y} * frame_.width + x;
  }

  void add_colors(uint32_t first, uint32_t count, Channels& channels) {
    linear_.clear();
    for (std::size_t i = at(0, first); i < at(0, first + count); ++i) {
      const vec4& color = frame_.colors[i];
      linear_.emplace_back(linear_from_srgb(color.x), linear_from_srgb(color.y),
                           linear_from_srgb(color.z), color.w);
    }
    channels.add("R", Imf::FLOAT, linear_.data(), 0);
    channels.add("G", Imf::FLOAT, linear_.data(), kComponent);
    channels.add("B", Imf::FLOAT, linear_.data(), 2 * kComponent);
    channels.add("A", Imf::FLOAT, linear_.data(), 3 * kComponent);
  }

  void add_aovs(const PixelAovs* pixels, Channels& channels) const {
    constexpr std::size_t normal = offsetof(PixelAovs, normal_z);
    constexpr std::size_t geometric = offsetof(PixelAovs, geometric_u);
    if (has(Aov::normal)) {
      channels.add("N.X", Imf::FLOAT, pixels, normal);
      channels.add("N.Y", Imf::FLOAT, pixels, normal + kComponent);
      channels.add("N.Z", Imf::FLOAT, pixels, normal + 2 * kComponent);
    }
    if (has(Aov::depth)) channels.add("Z", Imf::FLOAT, pixels, normal + 3 * kComponent);
    if (has(Aov::geometric)) {
      channels.add("G.X", Imf::FLOAT, pixels, geometric);
      channels.add("G.Y", Imf::FLOAT, pixels, geometric + kComponent);
      channels.add("G.Z", Imf::FLOAT, pixels, geometric + 2 * kComponent);
    }
    if (has(Aov::uv)) {
      channels.add("U", Imf::FLOAT, pixels, geometric + 3 * kComponent);
      channels.add("V", Imf::FLOAT, pixels, offsetof(PixelAovs, v));
    }
    if (has(Aov::patch)) {
      channels.add("patch", Imf::UINT, pixels, offsetof(PixelAovs, triangle));
    }
    if (has(Aov::evals)) {
      channels.add("evals", Imf::UINT, pixels, offsetof(PixelAovs, evaluations));
    }
  }

  void add_positions(uint32_t first, uint32_t count, Channels& channels) {
    positions_.clear();
    for (uint32_t y = first; y < first + count; ++y) {
      for (uint32_t x = 0; x < frame_.width; ++x) positions_.push_back(contents_.position(x, y));
    }
    channels.add("P.X", Imf::FLOAT, positions_.data(), 0);
    channels.add("P.Y", Imf::FLOAT, positions_.data(), kComponent);
    channels.add("P.Z", Imf::FLOAT, positions_.data(), 2 * kComponent);
  }

  const Frame& frame_;
  const ImageContents& contents_;
  Imath::V2i first_;
  std::vector<vec4> linear_;
  std::vector<glm::vec3> positions_;
};

void insert(const ImageAttribute& attribute, Imf::Header& header) {
  const auto with = [&](const Imf::Attribute& value) { header.insert(attribute.name, value); };
  if (const auto* text = std::get_if<std::string>(&attribute.value)) {
    with(Imf::StringAttribute(*text));
  } else if (const auto* whole = std::get_if<int>(&attribute.value)) {
    with(Imf::IntAttribute(*whole));
  } else if (const auto* number = std::get_if<double>(&attribute.value)) {
    with(Imf::DoubleAttribute(*number));
  } else if (const auto* vector = std::get_if<glm::dvec3>(&attribute.value)) {
    with(Imf::V3dAttribute(Imath::V3d(vector->x, vector->y, vector->z)));
  }
}

}  // namespace

void write_exr(const Frame& frame, const AtomicFile& file, const ImageContents& contents) {
  const FramePlace place = contents.place.value_or(FramePlace{0, 0, frame.width, frame.height});
  const Imath::V2i first(static_cast<int>(place.x), static_cast<int>(place.y));
  const Imath::V2i size(static_cast<int>(frame.width), static_cast<int>(frame.height));
  Imf::Header header(static_cast<int>(place.image_width), static_cast<int>(place.image_height),
                     Imath::Box2i(first, first + size - Imath::V2i(1)));
  // sRGB's primaries and white, which are Rec. ITU-R BT.709's: the values that this begins with.
  Imf::addChromaticities(header, Imf::Chromaticities());
  for (const ImageAttribute& attribute : contents.attributes) insert(attribute, header);
  FrameRows rows(frame, contents, first);
  const Imf::FrameBuffer channels = rows.band(0, 1);
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    header.channels().insert(channel.name(), Imf::Channel(channel.slice().type));
  }
  write_exr_rows(
      header, [&](uint32_t row, uint32_t count) { return rows.band(row, count); }, file);
}

}  // namespace trisect
