#include "app/picture/image_reader.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIntAttribute.h>
#include <ImfStringAttribute.h>
#include <ImfVecAttribute.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <system_error>

#include "app/base/error.h"
#include "app/base/read_file.h"
#include "app/base/srgb.h"
#include "app/picture/exr_pixels.h"
#include "app/picture/image_file.h"
#include "app/picture/open_exr.h"
#include "app/picture/png_pixels.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

Frame read_png(const fs::path& path) {
  const PngValues png = read_png_values(path);
  Frame frame;
  frame.resize(png.width, png.height, false);
  const std::size_t components = png.alpha ? 4 : 3;
  for (std::size_t i = 0; i < frame.colors.size(); ++i) {
    const auto at = [&](std::size_t k) {
      return static_cast<float>(png.values[i * components + k]);
    };
    frame.colors[i] = vec4(at(0), at(1), at(2), png.alpha ? at(3) : 65535.0F) / 65535.0F;
  }
  return frame;
}

// Where in a frame the values of one channel go.
struct Slot {
  const char* name;
  Imf::PixelType type;
  char* first;
  std::size_t stride;
};

bool has(const Imf::ChannelList& channels, const Slot& slot) {
  const Imf::Channel* channel = channels.findChannel(slot.name);
  return channel != nullptr && channel->xSampling == 1 && channel->ySampling == 1;
}

std::vector<Slot> color_slots(Frame& frame) {
  vec4& color = frame.colors.front();
  const auto slot = [](const char* name, float& first) {
    return Slot{name, Imf::FLOAT, reinterpret_cast<char*>(&first), sizeof(vec4)};
  };
  return {slot("R", color.x), slot("G", color.y), slot("B", color.z), slot("A", color.w)};
}

std::vector<Slot> aov_slots(Frame& frame) {
  PixelAovs& aov = frame.aovs.front();
  std::vector<Slot> slots;
  const auto add = [&](const char* name, Imf::PixelType type, void* first) {
    slots.push_back({name, type, static_cast<char*>(first), sizeof(PixelAovs)});
  };
  add("N.X", Imf::FLOAT, &aov.normal_z.x);
  add("N.Y", Imf::FLOAT, &aov.normal_z.y);
  add("N.Z", Imf::FLOAT, &aov.normal_z.z);
  add("Z", Imf::FLOAT, &aov.normal_z.w);
  add("G.X", Imf::FLOAT, &aov.geometric_u.x);
  add("G.Y", Imf::FLOAT, &aov.geometric_u.y);
  add("G.Z", Imf::FLOAT, &aov.geometric_u.z);
  add("U", Imf::FLOAT, &aov.geometric_u.w);
  add("V", Imf::FLOAT, &aov.v);
  add("patch", Imf::UINT, &aov.triangle);
  return slots;
}

void insert(Imf::FrameBuffer& buffer, const Slot& slot, const Imath::Box2i& window,
            std::size_t width) {
  // The fill value 1 is the alpha of a file without alpha.
  buffer.insert(slot.name, Imf::Slice::Make(slot.type, slot.first, window, slot.stride,
                                            slot.stride * width, 1, 1, 1.0));
}

Frame read_exr(const fs::path& path) {
  return with_exr(path, [&](Imf::InputFile& file) {
    const Imath::Box2i window = file.header().dataWindow();
    Frame frame;
    frame.resize(static_cast<uint32_t>(window.max.x - window.min.x + 1),
                 static_cast<uint32_t>(window.max.y - window.min.y + 1), true);
    const Imf::ChannelList& channels = file.header().channels();
    const auto present = [&](const Slot& slot) { return has(channels, slot); };
    const std::vector<Slot> colors = color_slots(frame);
    if (!std::all_of(colors.begin(), colors.begin() + 3, present)) {
      throw unreadable(path, "it has no channels R, G and B");
    }
    Imf::FrameBuffer buffer;
    for (const Slot& slot : colors) insert(buffer, slot, window, frame.width);
    const std::vector<Slot> aovs = aov_slots(frame);
    const bool with_aovs = std::all_of(aovs.begin(), aovs.end(), present);
    for (const Slot& slot : aovs) {
      if (with_aovs) insert(buffer, slot, window, frame.width);
    }
    read_pixels(file, buffer);
    if (!with_aovs) frame.aovs.clear();
    for (vec4& color : frame.colors) {
      for (int k = 0; k < 3; ++k) color[k] = srgb_from_linear(color[k]);
    }
    return frame;
  });
}

ImageTexts exr_attributes(const fs::path& path) {
  return with_exr(path, [](const Imf::InputFile& file) {
    ImageTexts found;
    const Imf::Header& header = file.header();
    for (auto entry = header.begin(); entry != header.end(); ++entry) {
      const auto add = [&](const ImageValue& value) {
        found.emplace_back(entry.name(), value_text(value));
      };
      const Imf::Attribute& attribute = entry.attribute();
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute)) {
        add(text->value());
      } else if (const auto* whole = dynamic_cast<const Imf::IntAttribute*>(&attribute)) {
        add(whole->value());
      } else if (const auto* number = dynamic_cast<const Imf::DoubleAttribute*>(&attribute)) {
        add(number->value());
      } else if (const auto* vector = dynamic_cast<const Imf::V3dAttribute*>(&attribute)) {
        add(glm::dvec3(vector->value().x, vector->value().y, vector->value().z));
      }
    }
    return found;
  });
}

// Throws UsageError for a picture that is neither PNG nor EXR, InputError for one that is not
// there.
bool is_png(const fs::path& path) {
  std::error_code unused;
  const bool is_named = !fs::is_directory(path, unused);
  const ImageFormat format = is_named ? image_format(path) : ImageFormat::png;
  if (format != ImageFormat::pfm) {
    expect_readable_file(path);
    return format == ImageFormat::png;
  }
  throw UsageError(path.string() + ": PNG and EXR are read, PFM is only written.");
}

}  // namespace

Frame read_image(const fs::path& path) {
  return is_png(path) ? read_png(path) : read_exr(path);
}

ImageTexts read_attributes(const fs::path& path) {
  return is_png(path) ? read_png_texts(path) : exr_attributes(path);
}

}  // namespace trisect
