#pragma once

#include <Eigen/Core>

/// Signs decided exactly for the given doubles: floating point where a proven error bound allows
/// it, then interval arithmetic, then exact arithmetic. Every number must be finite. Thread-safe.
namespace tetraglass::mesh {

/// Sign of (b - a) x (c - a) . (d - a): 1 for a positively oriented tetrahedron, 0 if the points
/// are coplanar.
[[nodiscard]] int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                              const Eigen::Vector3d& c, const Eigen::Vector3d& d);

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

/// For four coplanar points, a, b and c not collinear: 1 if c and d lie strictly on the same side
/// of the line through a and b, -1 on opposite sides, 0 if d lies on the line.
[[nodiscard]] int same_side_of_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// Whether three points lie on one line (or coincide).
[[nodiscard]] bool collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c);

}  // namespace tetraglass::mesh
