#include "tests/certify/certificate_check.h"

#include <array>
#include <boost/multiprecision/mpfr.hpp>
#include <cstddef>
#include <optional>
#include <vector>

namespace trisect::test {
namespace {

using Real = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<50, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

struct Vector {
  Real x;
  Real y;
  Real z;
};

Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector operator*(const Vector& a, const Real& k) {
  return {a.x * k, a.y * k, a.z * k};
}
Real dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Real length(const Vector& a) {
  return sqrt(dot(a, a));
}
template <typename Numbers>
Vector exactly(const Numbers& a) {
  return {Real(a.x), Real(a.y), Real(a.z)};
}

// The weights 1 and 2 of a point.
struct Weights {
  Real u;
  Real v;

  [[nodiscard]] Real at(std::size_t vertex) const {
    return vertex == 0 ? 1 - u - v : vertex == 1 ? u : v;
  }
};

class Surface {
 public:
  Surface(const SurfaceChoice& choice, const Triangle& tri) : choice_(choice) {
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      P_[k] = exactly(tri.Position[i]);
      N_[k] = exactly(tri.Normal[i]);
      data_[k] = exactly(tri.VertexData[i]);
      // The direction of the height shell is the quotient in double precision.
      const glm::dvec3 D = choice.shell == SHELL_HEIGHT
                               ? glm::dvec3(tri.Normal[i]) / static_cast<double>(tri.NormDot[i])
                               : glm::dvec3(tri.Normal[i]);
      D_[k] = exactly(D);
    }
  }

  // Whether the coordinates of points are cubic polynomials of the weights.
  [[nodiscard]] bool is_cubic() const {
    return choice_.surface == SURFACE_FLAT ||
           (choice_.surface == SURFACE_PHONG && choice_.shell == SHELL_NORMAL);
  }

  [[nodiscard]] Vector point(const Weights& w) const {
    Vector T = blend(P_, w);
    if (choice_.surface == SURFACE_FLAT) return T;
    const Vector D = blend(D_, w);
    if (choice_.surface == SURFACE_SPHERE) return T + D * sphere(w, T, D);
    return T + D * (choice_.shell == SHELL_NORMAL ? phong(w) : projected_phong(w, T, D));
  }

 private:
  static Vector blend(const std::array<Vector, 3>& a, const Weights& w) {
    return a[0] * w.at(0) + a[1] * w.at(1) + a[2] * w.at(2);
  }

  // alpha sum_{i<j} w_i w_j (P_j - P_i).(N_j - N_i)
  [[nodiscard]] Real phong(const Weights& w) const {
    Real sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i + 1; j < 3; ++j) {
        sum += w.at(i) * w.at(j) * dot(P_[j] - P_[i], N_[j] - N_[i]);
      }
    }
    return choice_.alpha * sum;
  }

  // T projected on the three tangent planes, blended, mixed by alpha (Boubekeur & Alexa 2008, eq.
  // 1), and that projected on the line T + s D.
  [[nodiscard]] Real projected_phong(const Weights& w, const Vector& T, const Vector& D) const {
    Vector moved{0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      moved = moved + N_[i] * (w.at(i) * dot(P_[i] - T, N_[i]));
    }
    return choice_.alpha * dot(moved, D) / dot(D, D);
  }

  // How far along the unit vector e, from the point at x of the vertex, its sphere is, whose centre
  // is at -N / c: t with c t^2 + 2 B t + C = 0. Where the line is flatter to the sphere than 60
  // degrees off its normal, or misses it, what the surface has instead.
  static Real to_sphere(const Vector& x, const Vector& e, const Vector& N, const Real& c) {
    const Real B = c * dot(x, e) + dot(e, N);
    const Real C = c * dot(x, x) + 2 * dot(x, N);
    const Real square = B * B - c * C;
    Real held = square;
    if (square < Real(0.25)) {
      held = Real(0.125) + (square > 0 ? Real(2 * square * square) : Real(0));
    }
    const Real sum = B + sqrt(held);
    Real inverse = 0;
    if (sum > 0) inverse = sum < 1 ? Real(sum * sum * (4 - 3 * sum)) : Real(1 / sum);
    const Real nearer = c * dot(x, x) / (c * c * dot(x, x) + Real(0.25));
    return ((held - square) * nearer - C) * inverse;
  }

  [[nodiscard]] Real height(std::size_t vertex, const Weights& w, const Vector& T,
                            const Vector& D) const {
    const std::size_t a = vertex == 0 ? 1 : 0;  // the neighbours, the lower number first
    const std::size_t b = vertex == 2 ? 1 : 2;
    const Vector x = T - P_[vertex];
    const Vector toward_b = P_[b] - P_[vertex];
    Real angle =
        dot(x, x) == 0 ? Real(0) : Real(atan2(length(cross(x, toward_b)), dot(x, toward_b)));
    if (w.at(a) < 0) angle = -angle;
    Real share = angle / data_[vertex].z;
    if (share < -1) share = -1;
    if (share > 2) share = 2;
    const Real c = data_[vertex].y + share * (data_[vertex].x - data_[vertex].y);
    // Beyond 5/4 of the distance from the vertex held by a parabola, which ends at 25/12 of it with
    // 5/3.
    const Real size = length(D);
    const Real far = length(x);
    Real t = to_sphere(x, D * (1 / size), N_[vertex], c);
    if (4 * abs(t) > 5 * far) {
      Real left = Real(1.25) - abs(t) / far * 3 / 5;
      if (left < 0) left = 0;
      const Real most = far * 5 / 3 * (1 - left * left);
      t = t < 0 ? Real(-most) : most;
    }
    return t / size;
  }

  [[nodiscard]] Real sphere(const Weights& w, const Vector& T, const Vector& D) const {
    return w.at(0) * height(0, w, T, D) + w.at(1) * height(1, w, T, D) +
           w.at(2) * height(2, w, T, D);
  }

  SurfaceChoice choice_;
  std::array<Vector, 3> P_;
  std::array<Vector, 3> N_;
  std::array<Vector, 3> D_;
  std::array<Vector, 3> data_;
};

struct Piece {
  Vector origin;
  Real size;

  explicit Piece(const in_double::SubTriangle& piece)
      : origin(exactly(piece.origin)), size(piece.size) {}

  // The patch's weights of the point with weights u and v within.
  [[nodiscard]] Weights out(const Real& u, const Real& v) const {
    return {origin.y + u * size, origin.z + v * size};
  }
  // The least weight within of a point.
  [[nodiscard]] Real least(const Weights& w) const {
    const Real u = (w.u - origin.y) / size;
    const Real v = (w.v - origin.z) / size;
    const Real first = 1 - u - v;
    const Real& smaller = u < v ? u : v;
    return first < smaller ? first : smaller;
  }
};

class Check {
 public:
  Check(const RayTube& tube, const SurfaceChoice& choice, const Triangle& tri)
      : surface_(choice, tri),
        origin_(exactly(tube.origin)),
        axes_{exactly(tube.across[0]), exactly(tube.across[1]), exactly(tube.direction)},
        radius_(tube.radius),
        t_min_(tube.t_min) {}

  // The point along axis 0 or 1 across the tube, or, 2, along it.
  [[nodiscard]] Real place(const Weights& w, std::size_t axis) const {
    return dot(surface_.point(w) - origin_, axes_[axis]);
  }

  // Whether factor.(place along each axis) is above the bound all over the piece.
  [[nodiscard]] Opinion is_above(const Piece& piece, const glm::dvec3& factor,
                                 const Real& bound) const {
    const Vector along =
        axes_[0] * Real(factor.x) + axes_[1] * Real(factor.y) + axes_[2] * Real(factor.z);
    const auto value = [&](int i, int j, int n) {
      const Weights w = piece.out(Real(i) / n, Real(j) / n);
      return dot(surface_.point(w) - origin_, along);
    };
    for (const auto& [i, j] : points()) {
      if (value(i, j, kPoints) <= bound) return Opinion::refuted;
    }
    if (!surface_.is_cubic()) return Opinion::supported;
    // The cubic's Bernstein coefficients from its values where the weights are thirds.
    const auto at = [&](int i, int j) { return value(i, j, 3); };
    std::array<Real, 10> b;
    b[0] = at(0, 0);
    b[1] = at(3, 0);
    b[2] = at(0, 3);
    const auto edge = [&](const Real& f0, const Real& f1, const Real& f2, const Real& f3) {
      return Real((-5 * f0 + 18 * f1 - 9 * f2 + 2 * f3) / 6);
    };
    b[3] = edge(b[0], at(1, 0), at(2, 0), b[1]);
    b[4] = edge(b[1], at(2, 0), at(1, 0), b[0]);
    b[5] = edge(b[1], at(2, 1), at(1, 2), b[2]);
    b[6] = edge(b[2], at(1, 2), at(2, 1), b[1]);
    b[7] = edge(b[2], at(0, 2), at(0, 1), b[0]);
    b[8] = edge(b[0], at(0, 1), at(0, 2), b[2]);
    Real edges = 0;
    for (std::size_t k = 3; k < 9; ++k) edges += b[k];
    b[9] = (27 * at(1, 1) - (b[0] + b[1] + b[2]) - 3 * edges) / 6;
    for (const Real& coefficient : b) {
      if (coefficient <= bound) return Opinion::supported;
    }
    return Opinion::proven;
  }

  // The root that Newton's method, with differences for derivatives, comes to.
  [[nodiscard]] std::optional<Weights> root(Weights w, const Real& e0, const Real& e1) const {
    const Real step("1e-20");
    for (int i = 0; i < 25; ++i) {
      const auto F = [&](const Weights& at) {
        const Vector S = surface_.point(at) - origin_;
        return std::array<Real, 2>{dot(S, axes_[0]) - e0, dot(S, axes_[1]) - e1};
      };
      const auto f = F(w);
      const auto fu = F({w.u + step, w.v});
      const auto fv = F({w.u, w.v + step});
      const Real a = (fu[0] - f[0]) / step;
      const Real b = (fv[0] - f[0]) / step;
      const Real c = (fu[1] - f[1]) / step;
      const Real d = (fv[1] - f[1]) / step;
      const Real determinant = a * d - b * c;
      if (determinant == 0) return std::nullopt;
      const Real du = (b * f[1] - d * f[0]) / determinant;
      const Real dv = (c * f[0] - a * f[1]) / determinant;
      w = {w.u + du, w.v + dv};
      if (abs(w.u) > 100 || abs(w.v) > 100) return std::nullopt;
      // A step leaves an error of its square, and of its size times that of the differences.
      if (abs(du) < Real("1e-25") && abs(dv) < Real("1e-25")) return w;
    }
    return std::nullopt;
  }

  // The offsets of five rays: the middle one, and those at the tube's edges.
  [[nodiscard]] std::array<std::array<Real, 2>, 5> rays() const {
    const Real& r = radius_;
    return {{{0, 0}, {r, r}, {-r, r}, {r, -r}, {-r, -r}}};
  }

  [[nodiscard]] Opinion no_root(const Piece& core) const {
    for (const auto& [i, j] : points()) {
      const Weights w = core.out(Real(i) / kPoints, Real(j) / kPoints);
      if (abs(place(w, 0)) <= radius_ && abs(place(w, 1)) <= radius_) return Opinion::refuted;
    }
    // Where there is no root anywhere the method finds none.
    for (const auto& [e0, e1] : rays()) {
      const std::optional<Weights> found = root(core.out(Real(1) / 3, Real(1) / 3), e0, e1);
      if (found && core.least(*found) >= 0) return Opinion::refuted;
    }
    return Opinion::supported;
  }

  [[nodiscard]] Opinion one_root(const Certificate& certificate) const {
    const Piece piece(certificate.piece);
    const Weights claimed{Real(certificate.weights.y), Real(certificate.weights.z)};
    const Real reach(certificate.weight_radius);
    std::optional<Weights> middle;
    for (const auto& [e0, e1] : rays()) {
      const std::optional<Weights> found = root(claimed, e0, e1);
      if (!found) return Opinion::unknown;
      const Real t = place(*found, 2);
      const bool is_there = abs(found->u - claimed.u) <= reach &&
                            abs(found->v - claimed.v) <= reach && piece.least(*found) >= 0 &&
                            t >= certificate.t.lo && t <= certificate.t.hi;
      if (!is_there) return Opinion::refuted;
      if (!middle) middle = found;
    }
    for (const auto& [u, v] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1)}) {
      const std::optional<Weights> other = root(piece.out(u, v), 0, 0);
      if (!other || piece.least(*other) < 0) continue;
      const Real apart = abs(other->u - middle->u) + abs(other->v - middle->v);
      if (apart > Real("1e-20")) return Opinion::refuted;
    }
    return Opinion::supported;
  }

  [[nodiscard]] const Real& radius() const { return radius_; }
  [[nodiscard]] const Real& t_min() const { return t_min_; }

 private:
  // Points of a piece with these numbers over kPoints for weights: corners, some on each edge, and
  // some within.
  static constexpr int kPoints = 12;
  static const std::vector<std::pair<int, int>>& points() {
    static const std::vector<std::pair<int, int>> all{
        {0, 0}, {12, 0}, {0, 12}, {4, 0}, {8, 0}, {0, 4}, {0, 8}, {8, 4},
        {4, 8}, {4, 4},  {2, 2},  {8, 2}, {2, 8}, {6, 5}, {1, 6}, {5, 1}};
    return all;
  }

  Surface surface_;
  Vector origin_;
  std::array<Vector, 3> axes_;
  Real radius_;
  Real t_min_;
};

}  // namespace

glm::dvec3 point_in_fifty_digits(const SurfaceChoice& choice, const Triangle& tri,
                                 const glm::dvec3& w) {
  const Vector S = Surface(choice, tri).point({Real(w.y), Real(w.z)});
  return {static_cast<double>(S.x), static_cast<double>(S.y), static_cast<double>(S.z)};
}

Opinion opinion_on(const Certificate& certificate, const RayTube& tube, const SurfaceChoice& choice,
                   const Triangle& tri) {
  const Check check(tube, choice, tri);
  const Piece piece(certificate.piece);
  switch (certificate.kind) {
    case CertificateKind::hull:
      return check.is_above(
          piece, {certificate.axis, 0.0},
          (abs(Real(certificate.axis.x)) + abs(Real(certificate.axis.y))) * check.radius());
    case CertificateKind::before:
      return check.is_above(piece, {0.0, 0.0, -1.0}, check.radius() - check.t_min());
    case CertificateKind::behind:
      return check.is_above(piece, {0.0, 0.0, 1.0}, Real(certificate.t.lo));
    case CertificateKind::no_root:
      return check.no_root(piece);
    default:
      return check.one_root(certificate);
  }
}

}  // namespace trisect::test
