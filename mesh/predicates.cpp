#include "mesh/predicates.h"

#include <cmath>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mpzf.h>

namespace tetraglass::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}
Kernel::Vector_3 vector(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
Kernel::Vector_2 vector(const Eigen::Vector2d& v) {
  return {v.x(), v.y()};
}
Kernel::Weighted_point_3 point(const WeightedPoint& p) {
  return {point(p.point), p.weight};
}

// The static error bounds of the determinants, after Shewchuk 1997, "Adaptive Precision
// Floating-Point Arithmetic and Fast Robust Geometric Predicates", section 4. His bounds of
// orient2d and orient3d start from differences of coordinates; here the entries are given, so fewer
// roundings count.
//
// Let u = 2^-53, D the determinant, P its permanent of absolute values, and D^, P^ what floating
// point makes of them in the same order of operations. In the 3 x 3 determinant every product of
// three entries passes through 5 roundings (product, difference of the minor, product, two sums):
// |D^ - D| <= ((1 + u)^5 - 1) P <= (5 u + 11 u^2) P, and P <= P^ / (1 - u)^5 <= (1 + 6 u) P^. With
// the rounding of the bound itself, (5 + 64 u) u P^ is enough. In the 2 x 2 determinant there are 2
// roundings: (2 + 16 u) u P^.
//
// A product that underflows has instead an absolute error of at most h = 2^-1075. In the 3 x 3
// determinant these add up to at most (2 h A + 3 h)(1 + u)^4 with A = |a_x| + |a_y| + |a_z|, in the
// 2 x 2 one to 2 h, and what P^ lost to underflow adds less than u times as much. (A + 2) 2^-1000
// and 2^-1000 are far more than that; they are no smaller so that the bound itself is computed in
// normal numbers (subnormal ones cost over a hundred cycles). Infinity and NaN, from overflow, fail
// the comparison.
//
// Where two columns of the 3 x 3 determinant are differences of given numbers, each brings one more
// rounding of its own: 7 of them, (7 + 64 u) u P^. A difference has no underflow.
constexpr double kU = 0x1p-53;
constexpr double kDifferencesBound3 = (7 + 64 * kU) * kU;
constexpr double kBound3 = (5 + 64 * kU) * kU;
constexpr double kBound2 = (2 + 16 * kU) * kU;
constexpr double kUnderflow = 0x1p-1000;

// Apart, and never inlined: its frame is large, and the filter that calls it is short.
[[gnu::noinline]] int decide_determinant(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                         const Eigen::Vector3d& c) {
  if (a.isZero(0) || b.isZero(0) || c.isZero(0)) return 0;
  return Kernel().orientation_3_object()(vector(a), vector(b), vector(c));
}

using ExactKernel = CGAL::Simple_cartesian<CGAL::Mpzf>;

[[gnu::noinline]] int decide_orientation_towards(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                                 const Eigen::Vector3d& c,
                                                 const Eigen::Vector3d& direction) {
  const auto exact = [](const Eigen::Vector3d& v) {
    return ExactKernel::Vector_3(v.x(), v.y(), v.z());
  };
  const ExactKernel::Vector_3 origin = exact(a);
  return CGAL::orientation(ExactKernel::Vector_3(exact(b) - origin),
                           ExactKernel::Vector_3(exact(c) - origin), exact(direction));
}

// A determinant with an approximation of it and the sum of the absolute values of its terms.
struct Determinant {
  double value;
  double permanent;
};

Determinant determinant_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                           const Eigen::Vector3d& c) {
  const double yz = b.y() * c.z();
  const double zy = b.z() * c.y();
  const double zx = b.z() * c.x();
  const double xz = b.x() * c.z();
  const double xy = b.x() * c.y();
  const double yx = b.y() * c.x();
  return {a.x() * (yz - zy) + a.y() * (zx - xz) + a.z() * (xy - yx),
          std::abs(a.x()) * (std::abs(yz) + std::abs(zy)) +
              std::abs(a.y()) * (std::abs(zx) + std::abs(xz)) +
              std::abs(a.z()) * (std::abs(xy) + std::abs(yx))};
}

double underflow_bound(const Eigen::Vector3d& a) {
  return kUnderflow * (std::abs(a.x()) + std::abs(a.y()) + std::abs(a.z()) + 2);
}

}  // namespace

int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d) {
  return Kernel().orientation_3_object()(point(a), point(b), point(c), point(d));
}

int sign_of_determinant(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c) {
  const Determinant determinant = determinant_of(a, b, c);
  const double bound = kBound3 * determinant.permanent + underflow_bound(a);
  if (determinant.value > bound) return 1;
  if (determinant.value < -bound) return -1;
  return decide_determinant(a, b, c);
}

int orientation_towards(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d u = b - a;
  const Eigen::Vector3d v = c - a;
  // In grids seen along an axis many faces are edge-on, and by their zeros alone.
  const auto no_term = [&](int i, int j, int k) {
    return direction[i] == 0 || ((u[j] == 0 || v[k] == 0) && (u[k] == 0 || v[j] == 0));
  };
  if (no_term(0, 1, 2) && no_term(1, 2, 0) && no_term(2, 0, 1)) return 0;
  const Determinant determinant = determinant_of(direction, u, v);
  const double bound = kDifferencesBound3 * determinant.permanent + underflow_bound(direction);
  if (determinant.value > bound) return 1;
  if (determinant.value < -bound) return -1;
  return decide_orientation_towards(a, b, c, direction);
}

int sign_of_determinant(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double left = a.x() * b.y();
  const double right = a.y() * b.x();
  const double determinant = left - right;
  const double bound = kBound2 * (std::abs(left) + std::abs(right)) + kUnderflow;
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  return Kernel().orientation_2_object()(vector(a), vector(b));
}

int in_sphere(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
              const Eigen::Vector3d& d, const Eigen::Vector3d& e) {
  return Kernel().side_of_oriented_sphere_3_object()(point(a), point(b), point(c), point(d),
                                                     point(e));
}

int in_power_sphere(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c,
                    const WeightedPoint& d, const WeightedPoint& e) {
  return Kernel().power_side_of_oriented_power_sphere_3_object()(point(a), point(b), point(c),
                                                                 point(d), point(e));
}

int same_side_of_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                      const Eigen::Vector3d& d) {
  return Kernel().coplanar_orientation_3_object()(point(a), point(b), point(c), point(d));
}

bool collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return Kernel().collinear_3_object()(point(a), point(b), point(c));
}

}  // namespace tetraglass::mesh
