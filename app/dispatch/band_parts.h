// The rays of a band of an image in parts, each of so many workgroups that the queue has room for
// their rays: the camera's first, then those toward the light.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "app/dispatch/workgroups.h"

namespace trisect {

class BandParts {
 public:
  struct Part {
    bool shadows;
    uint32_t first;  // workgroup
    uint32_t count;
  };

  // camera: the workgroups of the camera's rays; shadows: those of the shadow rays, none if it is
  // empty.
  BandParts(GroupRange camera, GroupRange shadows) : camera_(camera), shadows_(shadows) {}

  // The next parts, of together at most `budget` workgroups, each of at most `limit`; both at least
  // one.
  [[nodiscard]] std::vector<Part> next(uint32_t budget, uint32_t limit) const {
    std::vector<Part> parts;
    BandParts left = *this;
    while (budget > 0 && !left.is_done()) {
      const bool shadows = left.camera_.begin == left.camera_.end;
      GroupRange& range = shadows ? left.shadows_ : left.camera_;
      const uint32_t count = std::min({budget, limit, range.end - range.begin});
      parts.push_back({shadows, range.begin, count});
      range.begin += count;
      budget -= count;
    }
    return parts;
  }

  // There are camera rays in the workgroups before `end` only.
  void end_camera_at(uint32_t end) {
    camera_.end = std::min(camera_.end, std::max(end, camera_.begin));
  }

  // Takes off these parts, which next() returned and which are traced. Returns the number of their
  // workgroups.
  uint32_t finish(std::span<const Part> parts) {
    uint32_t groups = 0;
    for (const Part& part : parts) {
      GroupRange& range = part.shadows ? shadows_ : camera_;
      const uint32_t count = std::min(part.count, range.end - range.begin);
      range.begin += count;
      groups += count;
    }
    finished_ += groups;
    return groups;
  }

  // What part of the workgroups is finished, from 0 to 1.
  [[nodiscard]] double part_done() const {
    const double left =
        static_cast<double>(camera_.end - camera_.begin) + (shadows_.end - shadows_.begin);
    return left == 0.0 ? 1.0 : finished_ / (finished_ + left);
  }

  [[nodiscard]] bool is_done() const {
    return camera_.begin == camera_.end && shadows_.begin == shadows_.end;
  }

 private:
  GroupRange camera_;
  GroupRange shadows_;
  double finished_ = 0.0;
};

}  // namespace trisect
