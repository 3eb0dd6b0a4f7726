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

// One channel after the other, each a component of an array of structures.
class Channels {
 public:
  // first: the pixel at which the arrays begin.
  Channels(Imf::Header& header, std::size_t width, const Imath::V2i& first)
      : header_(header), width_(width), first_(first) {}

  template <typename Pixel>
  void add(const char* name, Imf::PixelType type, const std::vector<Pixel>& pixels,
           std::size_t offset) {
    header_.channels().insert(name, Imf::Channel(type));
    // OpenEXR's slices are not const; writing a file only reads them.
    auto* base = reinterpret_cast<char*>(const_cast<Pixel*>(pixels.data())) + offset;
    // OpenEXR addresses pixels by their coordinates in the image.
    const auto pixel = static_cast<std::ptrdiff_t>(sizeof(Pixel));
    const std::ptrdiff_t row = pixel * static_cast<std::ptrdiff_t>(width_);
    base -= first_.x * pixel + first_.y * row;
    slices_.insert(name, Imf::Slice(type, base, sizeof(Pixel), static_cast<std::size_t>(row)));
  }

  [[nodiscard]] const Imf::FrameBuffer& slices() const { return slices_; }

 private:
  Imf::Header& header_;
  std::size_t width_;
  Imath::V2i first_;
  Imf::FrameBuffer slices_;
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
  const auto has = [&](Aov aov) {
    return std::find(contents.aovs.begin(), contents.aovs.end(), aov) != contents.aovs.end();
  };
  Channels channels(header, frame.width, first);
  constexpr std::size_t component = sizeof(float);
  std::vector<vec4> linear;
  if (has(Aov::color)) {
    linear.reserve(frame.colors.size());
    for (const vec4& color : frame.colors) {
      linear.emplace_back(linear_from_srgb(color.x), linear_from_srgb(color.y),
                          linear_from_srgb(color.z), color.w);
    }
    channels.add("R", Imf::FLOAT, linear, 0);
    channels.add("G", Imf::FLOAT, linear, component);
    channels.add("B", Imf::FLOAT, linear, 2 * component);
    channels.add("A", Imf::FLOAT, linear, 3 * component);
  }
  if (!frame.aovs.empty()) {
    constexpr std::size_t normal = offsetof(PixelAovs, normal_z);
    constexpr std::size_t geometric = offsetof(PixelAovs, geometric_u);
    if (has(Aov::normal)) {
      channels.add("N.X", Imf::FLOAT, frame.aovs, normal);
      channels.add("N.Y", Imf::FLOAT, frame.aovs, normal + component);
      channels.add("N.Z", Imf::FLOAT, frame.aovs, normal + 2 * component);
    }
    if (has(Aov::depth)) channels.add("Z", Imf::FLOAT, frame.aovs, normal + 3 * component);
    if (has(Aov::geometric)) {
      channels.add("G.X", Imf::FLOAT, frame.aovs, geometric);
      channels.add("G.Y", Imf::FLOAT, frame.aovs, geometric + component);
      channels.add("G.Z", Imf::FLOAT, frame.aovs, geometric + 2 * component);
    }
    if (has(Aov::uv)) {
      channels.add("U", Imf::FLOAT, frame.aovs, geometric + 3 * component);
      channels.add("V", Imf::FLOAT, frame.aovs, offsetof(PixelAovs, v));
    }
    if (has(Aov::patch)) {
      channels.add("patch", Imf::UINT, frame.aovs, offsetof(PixelAovs, triangle));
    }
    if (has(Aov::evals)) {
      channels.add("evals", Imf::UINT, frame.aovs, offsetof(PixelAovs, evaluations));
    }
  }
  if (has(Aov::position) && !contents.positions.empty()) {
    channels.add("P.X", Imf::FLOAT, contents.positions, 0);
    channels.add("P.Y", Imf::FLOAT, contents.positions, component);
    channels.add("P.Z", Imf::FLOAT, contents.positions, 2 * component);
  }
  write_exr_pixels(header, channels.slices(), file);
}

}  // namespace trisect
