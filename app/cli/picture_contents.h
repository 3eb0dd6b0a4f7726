// What a picture's file gets of its frame.
#pragma once

#include "app/cli/options.h"
#include "app/cli/picture_source.h"
#include "app/frame/frame.h"
#include "app/picture/image_file.h"

namespace trisect {

class PictureContents {
 public:
  // Throws UsageError if the options ask for what the format cannot hold.
  PictureContents(ImageFormat format, const RenderOptions& options);

  // Whether the frame must have AOVs.
  [[nodiscard]] bool needs_aovs() const { return needs_aovs_; }

  // frame: of the picture's size. The result refers to it.
  [[nodiscard]] ImageContents of(const Frame& frame, const RenderOptions& options,
                                 const PictureSource& source) const;

 private:
  [[nodiscard]] bool has(Aov aov) const;

  std::vector<Aov> aovs_;
  bool needs_aovs_;
};

}  // namespace trisect
