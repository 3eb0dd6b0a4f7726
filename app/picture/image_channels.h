// The numbers of an image file as they are, channel by channel.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace trisect {

struct PngValues;

// The image of which a file is a part. x, y: of the part's top left pixel, from the image's; those
// of an EXR may lie outside.
struct ImageWindow {
  int64_t x = 0;
  int64_t y = 0;
  int64_t width = 0;  // the image's
  int64_t height = 0;

  bool operator==(const ImageWindow&) const = default;
};

// "at 2,3 in an image of 40x30"; "a whole image" for nothing.
std::string window_text(const std::optional<ImageWindow>& window);

// These throw InputError, naming the file, if it cannot be read, and UsageError for an unknown
// ending.

// Nothing if the file is a whole image: an EXR whose data window is its display window, a PNG that
// is no `--tile`.
std::optional<ImageWindow> read_window(const std::filesystem::path& path);

// A file of which a channel is read at a time. The constructor reads a PNG whole; of an EXR it
// looks whether all pixels are there.
class ImageChannels {
 public:
  explicit ImageChannels(const std::filesystem::path& path);
  ~ImageChannels();
  ImageChannels(const ImageChannels&) = delete;
  ImageChannels& operator=(const ImageChannels&) = delete;
  ImageChannels(ImageChannels&&) = delete;
  ImageChannels& operator=(ImageChannels&&) = delete;

  // Sorted: R, G and B of a PNG, and A if it has that; all channels of an EXR.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

  // The bits of one channel's numbers, in raster order: 16-bit numbers of a PNG (8 bits times 257),
  // single precision of an EXR's halves and floats, its unsigned numbers as they are. An EXR's
  // channel with fewer numbers than pixels is refused.
  [[nodiscard]] std::vector<uint32_t> bits(const std::string& name) const;

 private:
  std::filesystem::path path_;
  std::unique_ptr<const PngValues> png_;  // none of an EXR
  std::vector<std::string> names_;
};

}  // namespace trisect
