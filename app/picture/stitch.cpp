#include "app/picture/stitch.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <set>
#include <system_error>

#include "app/base/error.h"
#include "app/base/message.h"
#include "app/frame/frame.h"
#include "app/picture/exr_output.h"
#include "app/picture/exr_pixels.h"
#include "app/picture/image_reader.h"
#include "app/picture/open_exr.h"
#include "app/picture/png_pixels.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

// Where one picture is made in several places, these may be others in each.
constexpr const char* kMayDiffer[] = {"program", "commit", "device", "driver", "model", "accel"};

std::string text_named(const ImageTexts& texts, const std::string& name) {
  for (const auto& [key, value] : texts) {
    if (key == name) return value;
  }
  return {};
}

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw InputError(fmt::format("{}: {}.", path.string(), why));
}

// Which pixels of an image have been written.
class Coverage {
 public:
  Coverage(uint32_t width, uint32_t height)
      : width_(width), covered_(std::size_t{width} * height, false) {}

  void add(const ImagePart& part) {
    for (uint32_t y = part.y; y < part.y + part.height; ++y) {
      const auto row = covered_.begin() + static_cast<std::ptrdiff_t>(std::size_t{y} * width_);
      std::fill_n(row + part.x, part.width, true);
    }
  }

  // part: one of those that do not cover it.
  void expect_all(const fs::path& part) const {
    const auto missing = std::find(covered_.begin(), covered_.end(), false);
    if (missing == covered_.end()) return;
    const auto index = static_cast<std::size_t>(missing - covered_.begin());
    refuse(part, fmt::format("neither it nor another part has the pixel ({}, {})", index % width_,
                             index / width_));
  }

 private:
  uint32_t width_;
  std::vector<bool> covered_;
};

ImageTexts without(const std::set<std::string>& names, ImageTexts texts) {
  texts.erase(std::remove_if(texts.begin(), texts.end(),
                             [&](const auto& text) { return names.count(text.first) > 0; }),
              texts.end());
  return texts;
}

// What the parts of an image say of it.
class PartTexts {
 public:
  // Refuses a part that says of its image what the first one does not.
  void add(const fs::path& path, const ImageTexts& texts) {
    if (first_.empty()) {
      first_ = path;
      texts_ = texts;
    }
    const std::string name =
        difference_between(without({"tile"}, texts), without({"tile"}, texts_));
    if (!name.empty()) {
      refuse(path, fmt::format("is a part of another image than {}, with another {}",
                               first_.string(), name));
    }
    for (const char* may_differ : kMayDiffer) {
      if (text_named(texts, may_differ) != text_named(texts_, may_differ)) {
        not_of_all_.insert(may_differ);
      }
    }
  }

  // The names of what is not the same for all parts.
  [[nodiscard]] const std::set<std::string>& not_of_all() const { return not_of_all_; }

  // What all of them say.
  [[nodiscard]] ImageTexts of_all() const { return without(not_of_all_, texts_); }

 private:
  fs::path first_;
  ImageTexts texts_;
  std::set<std::string> not_of_all_{"tile"};
};

// Refuses an image that is larger than any of this program, before memory is taken for it.
void expect_size(const fs::path& path, uint32_t width, uint32_t height) {
  if (std::max(width, height) <= kLargestSide) return;
  refuse(path, fmt::format("is a part of an image of more than {} pixels a side", kLargestSide));
}

// The numbers of "800x600" or "0,0,16,24", between which that character stands; empty for any other
// text.
std::vector<uint32_t> numbers_in(const std::string& text, char between) {
  std::vector<uint32_t> numbers;
  const char* at = text.data();
  const char* end = at + text.size();
  while (true) {
    const auto [rest, error] = std::from_chars(at, end, numbers.emplace_back());
    if (error != std::errc() || (rest != end && *rest != between)) return {};
    if (rest == end) return numbers;
    at = rest + 1;
  }
}

// Of a PNG. Throws InputError if it does not say that.
FramePlace place_of(const fs::path& path, const ImageTexts& texts, const PngPixels& pixels) {
  const std::optional<FramePlace> place = place_in(texts);
  if (!place || text_named(texts, "tile") !=
                    fmt::format("{},{},{},{}", place->x, place->y, pixels.width, pixels.height)) {
    refuse(path, "does not say which part of which image it is");
  }
  expect_size(path, place->image_width, place->image_height);
  return *place;
}

void stitch_png(const std::vector<fs::path>& parts, const AtomicFile& file) {
  PngPixels whole;
  PartTexts part_texts;
  std::optional<Coverage> coverage;
  for (const fs::path& path : parts) {
    const ImageTexts texts = read_attributes(path);
    const PngPixels pixels = read_png_pixels(path);
    const FramePlace place = place_of(path, texts, pixels);
    const std::size_t components = pixels.alpha ? 4 : 3;
    if (!coverage) {
      whole = {place.image_width, place.image_height, pixels.alpha, {}};
      expect_pixels(whole.width, whole.height, components);
      whole.bytes.resize(std::size_t{whole.width} * whole.height * components);
      coverage.emplace(whole.width, whole.height);
    }
    part_texts.add(path, texts);
    if (pixels.alpha != whole.alpha) {
      refuse(path, fmt::format("has not the components of {}", parts.front().string()));
    }
    const std::size_t row_bytes = std::size_t{pixels.width} * components;
    for (std::size_t y = 0; y < pixels.height; ++y) {
      const std::size_t to = ((place.y + y) * whole.width + place.x) * components;
      std::copy_n(pixels.bytes.begin() + static_cast<std::ptrdiff_t>(y * row_bytes), row_bytes,
                  whole.bytes.begin() + static_cast<std::ptrdiff_t>(to));
    }
    coverage->add({place.x, place.y, pixels.width, pixels.height});
  }
  coverage->expect_all(parts.front());
  const std::size_t row_bytes = whole.bytes.size() / whole.height;
  const auto put = [&](uint32_t row, uint8_t* bytes) {
    std::copy_n(whole.bytes.data() + row * row_bytes, row_bytes, bytes);
  };
  write_png_rows({whole.width, whole.height, whole.alpha, put}, part_texts.of_all(), std::nullopt,
                 file);
}

std::size_t size_of(Imf::PixelType type) {
  return type == Imf::HALF ? 2 : 4;
}

// All channels of an image, as wide and high as its display window.
class ExrChannels {
 public:
  explicit ExrChannels(const Imf::Header& header) : window_(header.displayWindow()) {
    const std::size_t width = size(window_.min.x, window_.max.x);
    const std::size_t height = size(window_.min.y, window_.max.y);
    const Imf::ChannelList& channels = header.channels();
    std::size_t of_pixel = 0;
    for (auto at = channels.begin(); at != channels.end(); ++at) {
      of_pixel += size_of(at.channel().type);
    }
    expect_pixels(width, height, of_pixel);
    for (auto at = channels.begin(); at != channels.end(); ++at) {
      const Imf::PixelType type = at.channel().type;
      const std::size_t pixel = size_of(type);
      std::vector<char>& bytes = bytes_.emplace_back(width * height * pixel);
      const std::size_t row = pixel * width;
      slices_.insert(at.name(), Imf::Slice::Make(type, bytes.data(), window_, pixel, row));
    }
  }

  void read(Imf::InputFile& file) const { read_pixels(file, slices_); }

  [[nodiscard]] const Imf::FrameBuffer& slices() const { return slices_; }

  static uint32_t size(int first, int last) { return static_cast<uint32_t>(last - first + 1); }

 private:
  Imath::Box2i window_;
  std::vector<std::vector<char>> bytes_;
  Imf::FrameBuffer slices_;
};

// Of a data window in the display window that begins at `first`. Throws InputError if it is not
// in there.
ImagePart part_of(const fs::path& path, const Imf::Header& header) {
  const Imath::Box2i& all = header.displayWindow();
  const Imath::Box2i& part = header.dataWindow();
  if (!all.intersects(part.min) || !all.intersects(part.max)) {
    refuse(path, "has pixels outside of its image");
  }
  return {static_cast<uint32_t>(part.min.x - all.min.x),
          static_cast<uint32_t>(part.min.y - all.min.y), ExrChannels::size(part.min.x, part.max.x),
          ExrChannels::size(part.min.y, part.max.y)};
}

// Reads a file's pixels, but keeps none.
void read_to_the_end(const fs::path& path) {
  Imf::InputFile file = open_exr(path);
  const Imath::Box2i& window = file.header().dataWindow();
  const Imf::ChannelList& channels = file.header().channels();
  std::vector<char> row(std::size_t{ExrChannels::size(window.min.x, window.max.x)} * 4);
  Imf::FrameBuffer slices;
  for (auto at = channels.begin(); at != channels.end(); ++at) {
    const Imf::PixelType type = at.channel().type;
    // Every row goes to the same place: OpenEXR reads them by one thread here.
    char* base = row.data() - window.min.x * static_cast<std::ptrdiff_t>(size_of(type));
    slices.insert(at.name(), Imf::Slice(type, base, size_of(type), 0));
  }
  read_pixels(file, slices);
}

void stitch_exr(const std::vector<fs::path>& parts, const AtomicFile& file) {
  std::optional<Imf::Header> header;
  std::optional<ExrChannels> channels;
  std::optional<Coverage> coverage;
  PartTexts part_texts;
  for (const fs::path& path : parts) {
    part_texts.add(path, read_attributes(path));
    Imf::InputFile part = open_exr(path);
    const ImagePart place = part_of(path, part.header());
    if (!header) {
      header = part.header();
      const Imath::Box2i& all = header->displayWindow();
      const uint32_t width = ExrChannels::size(all.min.x, all.max.x);
      const uint32_t height = ExrChannels::size(all.min.y, all.max.y);
      expect_size(path, width, height);
      coverage.emplace(width, height);
      channels.emplace(*header);
    }
    if (part.header().displayWindow() != header->displayWindow() ||
        !(part.header().channels() == header->channels())) {
      refuse(path, fmt::format("has not the size or channels of {}", parts.front().string()));
    }
    channels->read(part);
    coverage->add(place);
  }
  coverage->expect_all(parts.front());
  header->dataWindow() = header->displayWindow();
  for (const std::string& name : part_texts.not_of_all()) header->erase(name.c_str());
  write_exr_rows(
      *header, [&](uint32_t, uint32_t) { return channels->slices(); }, file);
}

}  // namespace

std::string difference_between(const ImageTexts& a, const ImageTexts& b) {
  const bool counts_work = text_named(a, "evals") == "1" || text_named(b, "evals") == "1";
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const auto& [name, value] : *one) {
      const bool may_differ =
          std::find(std::begin(kMayDiffer), std::end(kMayDiffer), name) != std::end(kMayDiffer);
      const bool counts = !may_differ || (name == "accel" && counts_work);
      if (counts && text_named(*other, name) != value) return name;
    }
  }
  return {};
}

std::optional<FramePlace> place_in(const ImageTexts& attributes) {
  const std::vector<uint32_t> size = numbers_in(text_named(attributes, "size"), 'x');
  const std::vector<uint32_t> tile = numbers_in(text_named(attributes, "tile"), ',');
  if (size.size() != 2 || tile.size() != 4 ||
      !ImagePart{tile[0], tile[1], tile[2], tile[3]}.is_in(size[0], size[1])) {
    return std::nullopt;
  }
  return FramePlace{tile[0], tile[1], size[0], size[1]};
}

bool is_whole_image(const fs::path& path) {
  try {
    if (image_format(path) == ImageFormat::png) {
      read_png_pixels(path);
    } else {
      read_to_the_end(path);
    }
    return true;
  } catch (const std::exception& error) {
    if (is_lack_of_memory(error)) throw;
    return false;
  }
}

void stitch(const std::vector<fs::path>& parts, ImageFormat format, const AtomicFile& file) {
  for (const fs::path& path : parts) {
    if (image_format(path) != format) {
      throw UsageError(
          fmt::format("{}: is not of the format of {}.", path.string(), file.target().string()));
    }
  }
  if (format == ImageFormat::pfm) throw UsageError("a PFM does not say which part it is.");
  try {
    format == ImageFormat::png ? stitch_png(parts, file) : stitch_exr(parts, file);
  } catch (const std::exception& error) {
    if (is_told_as_it_is(error)) throw;
    refuse(file.target(), fmt::format("could not be made: {}", reason_of(error.what())));
  }
}

}  // namespace trisect
