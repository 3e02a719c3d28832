#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "project/image.h"
#include "project/scene.h"
#include "tests/stability/roundings.h"

namespace tetraglass::tests {

/// A convex body, however it is cut into cells, with a field that is linear all over it: what rays
/// see of it is known in closed form.
struct Convex {
  struct Side {
    Eigen::Vector3d normal;  ///< outwards, of any length
    double offset = 0;       ///< inside: normal.p <= offset
  };
  std::vector<Side> sides;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double at_origin = 0;

  [[nodiscard]] double value(const Eigen::Vector3d& p) const { return at_origin + gradient.dot(p); }
};

[[nodiscard]] Convex convex_box(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& gradient,
                                double at_origin);

/// A picture, and how far each of its channels may be off.
struct Bounded {
  project::Image image;
  project::Image bound;
};

/// Of sums over so many segments of a ray, and of what comes out.
[[nodiscard]] Eigen::Array4d summation_bound(const Eigen::Array4d& exact,
                                             const Roundings& roundings, double segments);

/// The scene's picture of the body by its closed form, in double. The bound is how much the closed
/// form changes by the roundings, each on its own in either direction: of the ray's position
/// (diagonally), of the sides by those of the vertices, of the
/// values everywhere, in the worst way, of its ends, of the values there; and the rounding of sums
/// over `segments` cells a ray at most.
[[nodiscard]] Bounded closed_form(const Convex& body, const project::Scene& scene,
                                  const Roundings& roundings, double segments);

}  // namespace tetraglass::tests
