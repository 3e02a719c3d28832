#pragma once

#include <Eigen/Core>

/// Signs decided exactly for the given doubles: floating point where a proven error bound allows
/// it, then interval arithmetic, then exact arithmetic. Every number must be finite. Thread-safe.
namespace tetraglass::mesh {

/// Sign of (b - a) x (c - a) . (d - a): 1 for a positively oriented tetrahedron, 0 if the points
/// are coplanar.
[[nodiscard]] int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                              const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// Sign of (b - a) x (c - a) . direction: on which side of the plane through a, b and c a point
/// lies that is infinitely far in this direction.
[[nodiscard]] int orientation_towards(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                      const Eigen::Vector3d& c, const Eigen::Vector3d& direction);

/// Sign of the determinant of the 3 x 3 matrix with columns a, b, c.
[[nodiscard]] int sign_of_determinant(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                      const Eigen::Vector3d& c);

/// Sign of the determinant of the 2 x 2 matrix with columns a, b.
[[nodiscard]] int sign_of_determinant(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// For a positively oriented tetrahedron abcd: 1 if e lies inside its circumsphere, -1 outside, 0
/// on it. The sign turns with the orientation of abcd.
[[nodiscard]] int in_sphere(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c, const Eigen::Vector3d& d,
                            const Eigen::Vector3d& e);

/// A point with a weight, the squared radius of a sphere around it (it may be negative).
struct WeightedPoint {
  Eigen::Vector3d point;
  double weight = 0;
};

/// The same for weights: for a positively oriented tetrahedron 1 if e is in conflict with the
/// sphere that is orthogonal to those of a, b, c and d (its power there is less than its weight),
/// -1 if not, 0 if the sphere is orthogonal to that of e too.
[[nodiscard]] int in_power_sphere(const WeightedPoint& a, const WeightedPoint& b,
                                  const WeightedPoint& c, const WeightedPoint& d,
                                  const WeightedPoint& e);

/// For four coplanar points, a, b and c not collinear: 1 if c and d lie strictly on the same side
/// of the line through a and b, -1 on opposite sides, 0 if d lies on the line.
[[nodiscard]] int same_side_of_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// Whether three points lie on one line (or coincide).
[[nodiscard]] bool collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c);

}  // namespace tetraglass::mesh
