// Control points: Martin Newell's teapot (University of Utah, 1975), as published by F. C. Crow,
// "The Origins of the Teapot", IEEE Computer Graphics and Applications 7(1), 1987, with the bottom
// that was added later; the figures were checked against teapot.inc of the Debian package
// povray-examples, whose one stray point (in the fourth patch of the lower body) is put where the
// other three quarters have theirs. The published patches repeat: those of revolution are a profile
// turned four times, those of the handle and of the spout come in mirrored pairs. Here z is up, as
// published.
#include "assets/generator/teapot.h"

#include <cmath>

namespace trisect::assets {
namespace {

using glm::dvec3;

using Row = std::array<dvec3, 4>;
using Patch = std::array<Row, 4>;  // rows along v, points of a row along u

// A profile point (distance from the axis, height) and the factor that makes a quarter circle of
// it.
struct ProfilePoint {
  double radius;
  double z;
  double circle = 0.56;
};
using Profile = std::array<ProfilePoint, 4>;

// From the inside of the rim over the body to the middle of the bottom, and the lid from its knob
// outward: seen from outside, all run to the left of a turn from x to -y.
constexpr Profile kRim{{{1.4, 2.4}, {1.3375, 2.53125}, {1.4375, 2.53125}, {1.5, 2.4}}};
constexpr Profile kUpperBody{{{1.5, 2.4}, {1.75, 1.875}, {2.0, 1.35}, {2.0, 0.9}}};
constexpr Profile kLowerBody{{{2.0, 0.9}, {2.0, 0.45}, {1.5, 0.225}, {1.5, 0.15}}};
constexpr Profile kBottom{{{1.5, 0.15}, {1.5, 0.075}, {1.425, 0.0}, {0.0, 0.0}}};
constexpr Profile kKnob{{{0.0, 3.15}, {0.8, 3.15, 0.5625}, {0.0, 2.85}, {0.2, 2.7}}};
constexpr Profile kLid{{{0.2, 2.7}, {0.4, 2.55}, {1.3, 2.55}, {1.3, 2.4}}};

// Half a tube's patch on the side y < 0, by its u = 0 and u = 1 edges in the plane y = 0 and its
// half width.
struct TubeRow {
  double x0, z0;
  double x1, z1;
  double half_width;
};
using Tube = std::array<TubeRow, 4>;

constexpr Tube kUpperHandle{{{-1.6, 2.025, -1.5, 2.25, 0.3},
                             {-2.3, 2.025, -2.5, 2.25, 0.3},
                             {-2.7, 2.025, -3.0, 2.25, 0.3},
                             {-2.7, 1.8, -3.0, 1.8, 0.3}}};
constexpr Tube kLowerHandle{{{-2.7, 1.8, -3.0, 1.8, 0.3},
                             {-2.7, 1.575, -3.0, 1.35, 0.3},
                             {-2.5, 1.125, -2.65, 0.9375, 0.3},
                             {-2.0, 0.9, -1.9, 0.6, 0.3}}};
constexpr Tube kLowerSpout{{{1.7, 1.425, 1.7, 0.6, 0.66},
                            {2.6, 1.425, 3.1, 0.825, 0.66},
                            {2.3, 2.1, 2.4, 2.025, 0.25},
                            {2.7, 2.4, 3.3, 2.4, 0.25}}};
constexpr Tube kUpperSpout{{{2.7, 2.4, 3.3, 2.4, 0.25},
                            {2.8, 2.475, 3.525, 2.49375, 0.25},
                            {2.9, 2.475, 3.45, 2.5125, 0.15},
                            {2.8, 2.4, 3.2, 2.4, 0.15}}};

// The quarter of a profile's surface from x toward -y, turned by `quarters` of a turn the same way.
Patch turned(const Profile& profile, int quarters) {
  Patch patch{};
  for (std::size_t j = 0; j < 4; ++j) {
    const auto& [r, z, circle] = profile[j];
    patch[j] = {dvec3(r, 0, z), dvec3(r, -circle * r, z), dvec3(circle * r, -r, z),
                dvec3(0, -r, z)};
    for (dvec3& p : patch[j]) {
      for (int k = 0; k < quarters; ++k) p = {p.y, -p.x, p.z};
    }
  }
  return patch;
}

Patch half_tube(const Tube& tube, bool mirrored) {
  Patch patch{};
  for (std::size_t j = 0; j < 4; ++j) {
    const TubeRow& row = tube[j];
    patch[j] = {dvec3(row.x0, 0, row.z0), dvec3(row.x0, -row.half_width, row.z0),
                dvec3(row.x1, -row.half_width, row.z1), dvec3(row.x1, 0, row.z1)};
    if (!mirrored) continue;
    // Mirrored, and turned around so that the outside stays outside.
    for (dvec3& p : patch[j]) p.y = -p.y;
    std::swap(patch[j][0], patch[j][3]);
    std::swap(patch[j][1], patch[j][2]);
  }
  return patch;
}

// A cubic Bezier curve and its derivative, by de Casteljau.
struct CurvePoint {
  dvec3 value;
  dvec3 derivative;
};
CurvePoint evaluate(const Row& b, double t) {
  const auto mixed = [t](const dvec3& p, const dvec3& q) { return p * (1.0 - t) + q * t; };
  const Row linear{mixed(b[0], b[1]), mixed(b[1], b[2]), mixed(b[2], b[3]), dvec3(0.0)};
  const dvec3 c0 = mixed(linear[0], linear[1]);
  const dvec3 c1 = mixed(linear[1], linear[2]);
  return {mixed(c0, c1), (c1 - c0) * 3.0};
}

Vertex evaluate(const Patch& patch, double u, double v) {
  Row along{};
  Row slope{};
  for (std::size_t j = 0; j < 4; ++j) {
    const CurvePoint p = evaluate(patch[j], u);
    along[j] = p.value;
    slope[j] = p.derivative;
  }
  const CurvePoint p = evaluate(along, v);
  const dvec3 across = evaluate(slope, v).value;
  dvec3 normal = glm::cross(across, p.derivative);
  // A row that shrinks to a point lies on the axis: the middle of the knob, or of the bottom.
  if (glm::length(normal) < 1e-9) normal = dvec3(0.0, 0.0, p.value.z > 1.0 ? 1.0 : -1.0);
  const auto y_up = [](const dvec3& w) { return dvec3(w.x, w.z, -w.y); };
  return {y_up(p.value), y_up(glm::normalize(normal))};
}

void add_patch(Model& model, const Patch& patch, int columns, int rows) {
  add_grid(model, columns, rows, [&](double u, double v) { return evaluate(patch, u, v); });
}

}  // namespace

TeapotDivisions divided(const TeapotDivisions& d, int times) {
  return {d.quarter * times,      d.rim * times,           d.upper_body * times,
          d.lower_body * times,   d.knob * times,          d.lid * times,
          d.bottom * times,       d.handle_around * times, d.handle_along * times,
          d.spout_around * times, d.spout_along * times};
}

Model teapot(const TeapotDivisions& d) {
  Model model("Newell's teapot");
  const std::array<std::pair<const Profile*, int>, 6> turns{{{&kRim, d.rim},
                                                             {&kUpperBody, d.upper_body},
                                                             {&kLowerBody, d.lower_body},
                                                             {&kBottom, d.bottom},
                                                             {&kKnob, d.knob},
                                                             {&kLid, d.lid}}};
  for (const auto& [profile, rows] : turns) {
    for (int k = 0; k < 4; ++k) add_patch(model, turned(*profile, k), d.quarter, rows);
  }
  for (const bool mirrored : {false, true}) {
    for (const Tube* tube : {&kUpperHandle, &kLowerHandle}) {
      add_patch(model, half_tube(*tube, mirrored), d.handle_around, d.handle_along);
    }
    for (const Tube* tube : {&kLowerSpout, &kUpperSpout}) {
      add_patch(model, half_tube(*tube, mirrored), d.spout_around, d.spout_along);
    }
  }
  return model;
}

}  // namespace trisect::assets
