// Proven answers: what all rays of a tube hit first in a scene of curved triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "app/bake/bake.h"
#include "app/base/keep_going.h"
#include "app/certify/certificate.h"
#include "app/certify/patch_certifier.h"
#include "app/oracle/box_tree.h"
#include "app/oracle/oracle.h"

namespace trisect {

// Why an answer is what it is. The first four are proven.
enum class Reason {
  nothing_near,  // a miss: the ray passes the boxes around all patches
  hulls,         // a miss: hulls of the pieces of all patches are off the ray
  contraction,   // a miss: hulls, and where they meet the ray Krawczyk's operator
  one_root,      // a hit: a single root by Krawczyk's operator, and nothing before it
  border,        // open: the ray passes the border of a patch
  fold,          // open: it grazes the surface
  nonsmooth,     // open: it comes to where tangents have no bound
  ray_start,     // open: it begins at a root
  order          // open: two roots are as near as each other
};
inline constexpr std::array kReasons{Reason::nothing_near, Reason::hulls,     Reason::contraction,
                                     Reason::one_root,     Reason::border,    Reason::fold,
                                     Reason::nonsmooth,    Reason::ray_start, Reason::order};

// The names in JSON and in the picture's key.
constexpr const char* reason_name(Reason reason) {
  switch (reason) {
    case Reason::nothing_near:
      return "nothing near";
    case Reason::hulls:
      return "hulls";
    case Reason::contraction:
      return "contraction";
    case Reason::one_root:
      return "one root";
    case Reason::border:
      return "border";
    case Reason::fold:
      return "fold";
    case Reason::nonsmooth:
      return "nonsmooth";
    case Reason::ray_start:
      return "ray start";
    default:
      return "order";
  }
}

constexpr bool is_proven(Reason reason) {
  return reason <= Reason::one_root;
}

struct CertifiedAnswer {
  Reason reason = Reason::nothing_near;
  // If reason is one_root: near where the ray in the tube's middle hits, and between which t all
  // rays of the tube do.
  OracleRoot root{};
  Interval t;

  // As an answer to judge others by (app/accuracy/classify.h): what is open is undecidable.
  [[nodiscard]] OracleAnswer answer() const {
    return {reason == Reason::one_root, is_proven(reason), root};
  }
};

// The truth is that of the oracle (oracle.h): the baked numbers that the kernels take, in exact
// arithmetic. Both sides of a triangle are hit.
class Certifier {
 public:
  // Keeps no reference. Encloses the patches, on all cores. Throws OutOfMemory.
  explicit Certifier(const BakedScene& scene);
  // The same; progress counts patches, as parallel_chunks has it, and nothing is returned if it
  // stops the work.
  static std::optional<Certifier> make(const BakedScene& scene, const Progress& progress);

  // For all rays within `radius` of this one, which has no end (t_max is not used). Adds the
  // certificates that it needed to `certificates`, if set. Safe to call from several threads.
  [[nodiscard]] CertifiedAnswer first(const OracleRay& ray, double radius,
                                      std::vector<Certificate>* certificates = nullptr) const;

 private:
  Certifier(const BakedScene& scene, const Progress& progress);

  SurfaceChoice choice_;
  std::vector<Triangle> triangles_;
  std::vector<PatchCertifier> patches_;
  BoxTree tree_;
  bool is_whole_ = true;
};

// The tube around a ray.
RayTube tube_around(const OracleRay& ray, double radius);

struct CertifiedFrame {
  uint32_t width;
  uint32_t height;
  std::vector<CertifiedAnswer> pixels;  // row by row
};

// The pixels of an image, on all cores: the tube of each is as wide as a ray may move without that
// an answer of the oracle's counts as decidable (kMotion). progress counts rows, as parallel_rows
// has it; nothing is returned if it stops the work.
std::optional<CertifiedFrame> certify_frame(const Certifier& certifier, const TraceParams& params,
                                            const Progress& progress);

}  // namespace trisect
