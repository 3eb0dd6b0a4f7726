#include "app/cli/picture_contents.h"

#include <algorithm>

#include "app/base/error.h"
#include "app/frame/supersampling.h"
#include "app/picture/hit_position.h"

namespace trisect {

PictureContents::PictureContents(ImageFormat format, const RenderOptions& options)
    : aovs_(options.aovs) {
  if (format == ImageFormat::png && !aovs_.empty()) {
    throw UsageError("--aov: a PNG holds the colour alone; EXR and PFM hold others.");
  }
  if (format == ImageFormat::png) aovs_ = {Aov::color};
  if (format == ImageFormat::pfm) {
    if (aovs_.empty()) aovs_ = {Aov::color};
    if (aovs_.size() > 1 || has(Aov::patch) || has(Aov::uv) || has(Aov::evals)) {
      throw UsageError("--aov: a PFM holds one of color, Z, N, G and P.");
    }
  }
  if (format == ImageFormat::exr) {
    if (aovs_.empty()) aovs_ = ImageContents{}.aovs;
    if (options.evals && !has(Aov::evals)) aovs_.push_back(Aov::evals);
  }
  needs_aovs_ = options.evals || aovs_ != std::vector<Aov>{Aov::color};
}

ImageContents PictureContents::of(const Frame& frame, const RenderOptions& options,
                                  const PictureSource& source) const {
  ImageContents contents;
  contents.aovs = aovs_;
  contents.alpha = options.background == Background::none;
  contents.attributes = attributes_of(options, source);
  FramePlace place{0, 0, options.width, options.height};
  if (options.tile) {
    place.x = options.tile->x;
    place.y = options.tile->y;
    contents.place = place;
  }
  if (has(Aov::position)) {
    contents.position = [&frame, camera = source.settings.camera,
                         across = samples_across(options.spp), place](uint32_t x, uint32_t y) {
      return hit_position(frame, x, y, camera, across, place);
    };
  }
  return contents;
}

bool PictureContents::has(Aov aov) const {
  return std::find(aovs_.begin(), aovs_.end(), aov) != aovs_.end();
}

}  // namespace trisect
