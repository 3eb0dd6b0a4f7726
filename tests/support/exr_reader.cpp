#include "tests/support/exr_reader.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>

#include <cstddef>
#include <cstdint>

namespace trisect::test {

Frame read_exr(const std::filesystem::path& path) {
  Imf::InputFile file(path.c_str());
  const Imath::Box2i box = file.header().dataWindow();
  Frame frame;
  frame.width = static_cast<uint32_t>(box.max.x - box.min.x + 1);
  frame.height = static_cast<uint32_t>(box.max.y - box.min.y + 1);
  frame.colors.resize(std::size_t{frame.width} * frame.height);
  frame.aovs.resize(frame.colors.size());
  Imf::FrameBuffer slices;
  const auto add = [&](const char* name, Imf::PixelType type, void* first, std::size_t pixel) {
    slices.insert(name, Imf::Slice(type, static_cast<char*>(first), pixel, pixel * frame.width));
  };
  vec4& color = frame.colors.front();
  PixelAovs& aov = frame.aovs.front();
  add("R", Imf::FLOAT, &color.x, sizeof(vec4));
  add("G", Imf::FLOAT, &color.y, sizeof(vec4));
  add("B", Imf::FLOAT, &color.z, sizeof(vec4));
  add("A", Imf::FLOAT, &color.w, sizeof(vec4));
  add("N.X", Imf::FLOAT, &aov.normal_z.x, sizeof(PixelAovs));
  add("N.Y", Imf::FLOAT, &aov.normal_z.y, sizeof(PixelAovs));
  add("N.Z", Imf::FLOAT, &aov.normal_z.z, sizeof(PixelAovs));
  add("Z", Imf::FLOAT, &aov.normal_z.w, sizeof(PixelAovs));
  add("G.X", Imf::FLOAT, &aov.geometric_u.x, sizeof(PixelAovs));
  add("G.Y", Imf::FLOAT, &aov.geometric_u.y, sizeof(PixelAovs));
  add("G.Z", Imf::FLOAT, &aov.geometric_u.z, sizeof(PixelAovs));
  add("U", Imf::FLOAT, &aov.geometric_u.w, sizeof(PixelAovs));
  add("V", Imf::FLOAT, &aov.v, sizeof(PixelAovs));
  add("patch", Imf::UINT, &aov.triangle, sizeof(PixelAovs));
  file.setFrameBuffer(slices);
  file.readPixels(box.min.y, box.max.y);
  return frame;
}

std::map<std::string, std::string> exr_channels(const std::filesystem::path& path) {
  const Imf::InputFile file(path.c_str());
  std::map<std::string, std::string> names;
  const Imf::ChannelList& channels = file.header().channels();
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    const Imf::PixelType type = channel.channel().type;
    names[channel.name()] = type == Imf::FLOAT ? "float" : type == Imf::UINT ? "uint" : "half";
  }
  return names;
}

std::vector<double> exr_channel(const std::filesystem::path& path, const std::string& channel) {
  Imf::InputFile file(path.c_str());
  const Imath::Box2i box = file.header().dataWindow();
  const std::size_t width = static_cast<uint32_t>(box.max.x - box.min.x + 1);
  const std::size_t count = width * static_cast<uint32_t>(box.max.y - box.min.y + 1);
  const auto read = [&]<typename Number>(Imf::PixelType type, std::vector<Number> numbers) {
    Imf::FrameBuffer slices;
    slices.insert(channel, Imf::Slice(type, reinterpret_cast<char*>(numbers.data()), sizeof(Number),
                                      sizeof(Number) * width));
    file.setFrameBuffer(slices);
    file.readPixels(box.min.y, box.max.y);
    return std::vector<double>(numbers.begin(), numbers.end());
  };
  return file.header().channels()[channel.c_str()].type == Imf::UINT
             ? read(Imf::UINT, std::vector<uint32_t>(count))
             : read(Imf::FLOAT, std::vector<float>(count));
}

std::vector<float> exr_chromaticities(const std::filesystem::path& path) {
  const Imf::InputFile file(path.c_str());
  if (!Imf::hasChromaticities(file.header())) return {};
  const Imf::Chromaticities& c = Imf::chromaticities(file.header());
  return {c.red.x, c.red.y, c.green.x, c.green.y, c.blue.x, c.blue.y, c.white.x, c.white.y};
}

}  // namespace trisect::test
