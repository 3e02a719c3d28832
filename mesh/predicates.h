#pragma once

#include <Eigen/Core>

/// Signs decided exactly for the given doubles (filtered floating point, exact arithmetic where the filter fails).
namespace tetraglass::mesh {

/// Sign of (b - a) x (c - a) . (d - a): 1 for a positively oriented tetrahedron, 0 if the points are coplanar.
/// Coordinates must be finite.
[[nodiscard]] int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                              const Eigen::Vector3d& d);

/// Sign of the determinant of the 3 x 3 matrix with columns a, b, c.
[[nodiscard]] int sign_of_determinant(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Sign of the determinant of the 2 x 2 matrix with columns a, b.
[[nodiscard]] int sign_of_determinant(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// For a positively oriented tetrahedron abcd: 1 if e lies inside its circumsphere, -1 outside, 0 on it.
[[nodiscard]] int in_sphere(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                            const Eigen::Vector3d& d, const Eigen::Vector3d& e);

}  // namespace tetraglass::mesh
