// Gives a second opinion on the certificates that prove what the pixels of an image show:
//   check-certificates MODEL SURFACE SHELL SIZE COUNT
// SURFACE: flat, phong or sphere. SHELL: normal or height. SIZE: the image's width and height.
// COUNT: how many of its certificates are looked at, spread evenly over them. Prints a row of a
// Markdown table, and the first that are refuted to standard error. Ends with 1 if there are some.
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

// Calls each(number, certificate, tube) for every certificate of the image; numbers count those of
// a row from where `first` says. Returns how many each row has.
template <typename Each>
std::vector<std::size_t> for_each_certificate(const Certifier& certifier, const TraceParams& params,
                                              const std::vector<std::size_t>& first,
                                              const Each& each) {
  const double radius = kMotion * static_cast<double>(params.anchor.w);
  std::vector<std::size_t> counts(params.height);
  parallel_rows(params.height,
                [&](uint32_t y) {
                  std::vector<Certificate> certificates;
                  std::size_t number = first.empty() ? 0 : first[y];
                  for (uint32_t x = 0; x < params.width; ++x) {
                    const OracleRay ray = oracle_pixel_ray(params, x, y).ray;
                    certificates.clear();
                    static_cast<void>(certifier.first(ray, radius, &certificates));
                    const RayTube tube = tube_around(ray, radius);
                    for (const Certificate& certificate : certificates) {
                      each(number++, certificate, tube);
                    }
                    counts[y] += certificates.size();
                  }
                },
                {});
  return counts;
}

int check(const std::string& model, const SurfaceChoice& choice, uint32_t size, std::size_t count) {
  const Mesh mesh = build_mesh(read_model(model), model).mesh;
  const BakedScene scene = bake(mesh, choice);
  const TraceParams params = make_params(scene, framed_settings(mesh, scene, size, size));
  const Certifier certifier(scene);
  const SurfaceChoice kernels_choice = with_single_alpha(choice);

  const std::vector<std::size_t> rows = for_each_certificate(
      certifier, params, {}, [](std::size_t, const Certificate&, const RayTube&) {});
  std::vector<std::size_t> first;
  std::size_t all = 0;
  for (const std::size_t row : rows) {
    first.push_back(all);
    all += row;
  }
  const std::size_t stride = std::max<std::size_t>(1, all / std::max<std::size_t>(1, count));

  Counts counts{};
  std::mutex printing;
  int printed = 0;
  for_each_certificate(
      certifier, params, first,
      [&](std::size_t number, const Certificate& certificate, const RayTube& tube) {
        if (number % stride != 0) return;
        const Opinion opinion =
            opinion_on(certificate, tube, kernels_choice, scene.triangles[certificate.triangle]);
        const auto kind = static_cast<std::size_t>(certificate.kind);
        ++counts.of[kind][static_cast<std::size_t>(opinion)];
        if (opinion != Opinion::refuted) return;
        const std::lock_guard lock(printing);
        if (++printed > 10) return;
        fmt::print(stderr, "{}: certificate {} ({}) of triangle {} is refuted\n", model, number,
                   kKinds[kind], certificate.triangle);
      });

  fmt::print("| {} | {} | {} | {} |", model_name(model), surface_name(choice.surface),
             shell_name(choice.shell), all);
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
    fmt::print(" {} |", counts.of_kind(kind));
  }
  fmt::print(" {} | {} | {} | {} |\n", counts.with(Opinion::proven),
             counts.with(Opinion::supported), counts.with(Opinion::unknown),
             counts.with(Opinion::refuted));
  return counts.with(Opinion::refuted) == 0 ? 0 : 1;
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
