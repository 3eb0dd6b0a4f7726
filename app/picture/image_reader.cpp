#include "app/picture/image_reader.h"
#include "app/base/srgb.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <exception>
#include <string>

#include "app/base/error.h"
#include "app/picture/image_file.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

InputError unreadable(const fs::path& path, const std::string& why) {
  return InputError(fmt::format("{}: could not be read: {}.", path.string(), why));
}

Frame read_png(const fs::path& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) {
    throw unreadable(path, static_cast<const char*>(image.message));
  }
  image.format = PNG_FORMAT_RGBA;
  std::vector<uint8_t> bytes(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr) == 0) {
    throw unreadable(path, static_cast<const char*>(image.message));
  }
  Frame frame;
  frame.width = image.width;
  frame.height = image.height;
  frame.colors.reserve(bytes.size() / 4);
  for (std::size_t i = 0; i < bytes.size(); i += 4) {
    frame.colors.push_back(vec4(bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]) / 255.0F);
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

// OpenEXR addresses pixels by their coordinates in the data window, which need not begin at (0, 0).
void insert(Imf::FrameBuffer& buffer, const Slot& slot, const Imath::Box2i& window,
            std::size_t width) {
  const std::size_t row = slot.stride * width;
  char* base = slot.first - window.min.x * static_cast<std::ptrdiff_t>(slot.stride) -
               window.min.y * static_cast<std::ptrdiff_t>(row);
  // The fill value 1 is the alpha of a file without alpha.
  buffer.insert(slot.name, Imf::Slice(slot.type, base, slot.stride, row, 1, 1, 1.0));
}

Frame read_exr(const fs::path& path) {
  try {
    Imf::InputFile file(path.c_str());
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
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    if (!with_aovs) frame.aovs.clear();
    for (vec4& color : frame.colors) {
      for (int k = 0; k < 3; ++k) color[k] = srgb_from_linear(color[k]);
    }
    return frame;
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw unreadable(path, error.what());
  }
}

}  // namespace

Frame read_image(const fs::path& path) {
  return image_format(path) == ImageFormat::png ? read_png(path) : read_exr(path);
}

}  // namespace trisect
