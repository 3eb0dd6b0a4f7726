// Gives a second opinion on the certificates that prove what the pixels of an image show:
//   check-certificates MODEL SURFACE SHELL SIZE COUNT
// SURFACE: flat, phong or sphere. SHELL: normal or height. SIZE: the image's width and height.
// COUNT: how many of its certificates are looked at, spread evenly over them. Whether those of a
// pixel together prove its answer is looked at for every pixel. Prints a row of a Markdown table,
// and the first that are refuted or leave a gap to standard error. Ends with 1 if there are some.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/bake/bake.h"
#include "app/base/parallel_rows.h"
#include "app/certify/certifier.h"
#include "app/dispatch/trace_settings.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "app/mesh/obj_file.h"
#include "app/oracle/oracle_tracer.h"
#include "app/surface/to_double.h"
#include "tests/certify/certificate_check.h"
#include "tests/certify/pixel_proof.h"

namespace trisect::test {
namespace {

constexpr std::array kKinds{"hull", "before", "behind", "no root", "one root"};
constexpr std::size_t kOpinions = 4;

struct Counts {
  std::array<std::array<std::atomic<std::size_t>, kOpinions>, kKinds.size()> of;

  [[nodiscard]] std::size_t with(Opinion opinion) const {
    std::size_t sum = 0;
    for (const auto& kind : of) sum += kind[static_cast<std::size_t>(opinion)];
    return sum;
  }
  [[nodiscard]] std::size_t of_kind(std::size_t kind) const {
    std::size_t sum = 0;
    for (const auto& count : of[kind]) sum += count;
    return sum;
  }
};

// Calls each(row, certificates, answer, tube) for every pixel of the image, on several threads, in
// the order of a row's pixels.
template <typename Each>
void for_each_pixel(const Certifier& certifier, const TraceParams& params, const Each& each) {
  const double radius = kMotion * static_cast<double>(params.anchor.w);
  parallel_rows(params.height,
                [&](uint32_t y) {
                  std::vector<Certificate> certificates;
                  for (uint32_t x = 0; x < params.width; ++x) {
                    const OracleRay ray = oracle_pixel_ray(params, x, y).ray;
                    certificates.clear();
                    const CertifiedAnswer answer = certifier.first(ray, radius, &certificates);
                    each(y, certificates, answer, tube_around(ray, radius));
                  }
                },
                {});
}

int check(const std::string& model, const SurfaceChoice& choice, uint32_t size, std::size_t count) {
  const Mesh mesh = build_mesh(read_model(model), model).mesh;
  const BakedScene scene = bake(mesh, choice);
  const TraceParams params = make_params(scene, framed_settings(mesh, scene, size, size));
  const Certifier certifier(scene);
  const SurfaceChoice kernels_choice = with_single_alpha(choice);

  // The numbers of the certificates before a row.
  std::vector<std::size_t> before(params.height + 1);
  std::mutex printing;
  int printed = 0;
  const auto complain = [&](const std::string& what) {
    const std::lock_guard lock(printing);
    if (++printed <= 10) fmt::print(stderr, "{}: {}\n", model, what);
  };
  std::atomic<std::size_t> proven_pixels = 0;
  std::atomic<std::size_t> gaps = 0;
  for_each_pixel(certifier, params,
                 [&](uint32_t y, const std::vector<Certificate>& certificates,
                     const CertifiedAnswer& answer, const RayTube& tube) {
                   before[y + 1] += certificates.size();
                   if (!is_proven(answer.reason)) return;
                   ++proven_pixels;
                   const std::string gap = gap_in(certificates, answer, tube, scene.triangles);
                   if (gap.empty()) return;
                   ++gaps;
                   complain(fmt::format("a proof in row {} has a gap: {}", y, gap));
                 });
  for (uint32_t y = 0; y < params.height; ++y) before[y + 1] += before[y];
  const std::size_t all = before.back();
  const std::size_t stride = std::max<std::size_t>(1, all / std::max<std::size_t>(1, count));

  Counts counts{};
  for_each_pixel(certifier, params,
                 [&](uint32_t y, const std::vector<Certificate>& certificates,
                     const CertifiedAnswer&, const RayTube& tube) {
                   for (const Certificate& certificate : certificates) {
                     const std::size_t number = before[y]++;
                     if (number % stride != 0) continue;
                     const Opinion opinion = opinion_on(certificate, tube, kernels_choice,
                                                        scene.triangles[certificate.triangle]);
                     const auto kind = static_cast<std::size_t>(certificate.kind);
                     ++counts.of[kind][static_cast<std::size_t>(opinion)];
                     if (opinion == Opinion::refuted) {
                       complain(fmt::format("certificate {} ({}) of triangle {} is refuted", number,
                                            kKinds[kind], certificate.triangle));
                     }
                   }
                 });

  fmt::print("| {} | {} | {} | {} | {} | {} |", model_name(model), surface_name(choice.surface),
             shell_name(choice.shell), proven_pixels, gaps, all);
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
    fmt::print(" {} |", counts.of_kind(kind));
  }
  fmt::print(" {} | {} | {} | {} |\n", counts.with(Opinion::proven),
             counts.with(Opinion::supported), counts.with(Opinion::unknown),
             counts.with(Opinion::refuted));
  return counts.with(Opinion::refuted) + gaps == 0 ? 0 : 1;
}

SurfaceChoice choice_of(const std::string& surface, const std::string& shell) {
  for (const uint name : {SURFACE_FLAT, SURFACE_PHONG, SURFACE_SPHERE}) {
    if (surface == surface_name(name)) {
      return {name, 0.65, shell == "height" ? SHELL_HEIGHT : SHELL_NORMAL};
    }
  }
  throw std::invalid_argument("SURFACE is flat, phong or sphere");
}

int run(const std::vector<std::string>& words) {
  if (words.size() != 5) {
    throw std::invalid_argument("usage: check-certificates MODEL SURFACE SHELL SIZE COUNT");
  }
  return check(words[0], choice_of(words[1], words[2]), static_cast<uint32_t>(std::stoul(words[3])),
               std::stoul(words[4]));
}

}  // namespace
}  // namespace trisect::test

int main(int argc, char** argv) {
  try {
    return trisect::test::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
