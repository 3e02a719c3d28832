#include "sort/image_triangle.h"

#include <algorithm>

namespace tetraglass::sort {
namespace {

using Eigen::Vector2d;

// Twice the area of pqr, positive counter-clockwise.
double turn(const Vector2d& p, const Vector2d& q, const Vector2d& r) {
  return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
}

// More than such an area is off by, of points no larger than m.
//
// Let u = 2^-53, e = 2^-49 m the error of each coordinate, A and B the sums of the absolute
// coordinates of q - p and r - p; these are at most 4 m. Each of their coordinates is off by 2 e,
// and its rounding u 4 m = e / 4 more. The area is off by 2.25 e (A + B) + 2 (2.25 e)^2 from that,
// by 2 u A B <= e B / 2 from the roundings of products and difference: less than 2.75 e 8 m + 11
// e^2 < 23 e m, and less than 2^-1000 by underflow. Infinity and NaN, from overflow, fail every
// comparison.
double bound(double m) {
  return 0x1p-44 * m * m + 0x1p-1000;
}

// Of the edges of `a`, which turns by `sign`: none if b lies beyond one of them; some if it reaches
// over each of them.
Overlap reach(const std::array<Vector2d, 3>& a, double sign, const std::array<Vector2d, 3>& b,
              double error) {
  Overlap result = Overlap::some;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2d& p = a[i];
    const Vector2d& q = a[(i + 1) % 3];
    const double highest =
        std::max({sign * turn(p, q, b[0]), sign * turn(p, q, b[1]), sign * turn(p, q, b[2])});
    if (highest < -error) return Overlap::none;
    if (!(highest > error)) result = Overlap::uncertain;
  }
  return result;
}

}  // namespace

Overlap find_overlap(const ImageTriangle& a, const ImageTriangle& b) {
  const double error = bound(std::max(a.size, b.size));
  const auto sign = [error](const ImageTriangle& t) {
    const double area = turn(t.corners[0], t.corners[1], t.corners[2]);
    return area > error ? 1.0 : area < -error ? -1.0 : 0.0;
  };
  const double sign_a = sign(a);
  const double sign_b = sign(b);
  if (sign_a == 0 || sign_b == 0) return Overlap::uncertain;
  const Overlap of_a = reach(a.corners, sign_a, b.corners, error);
  if (of_a == Overlap::none) return of_a;
  const Overlap of_b = reach(b.corners, sign_b, a.corners, error);
  return of_b == Overlap::some ? of_a : of_b;
}

}  // namespace tetraglass::sort
