#include "project/gl/normalization.h"

#include <algorithm>

namespace tetraglass::project::gl {

Normalization::Normalization(const Scene& scene) {
  // Halved before they are added or subtracted: numbers near the largest double must not overflow.
  const mesh::Box box = mesh::bounds(*scene.mesh);
  center = 0.5 * box.min() + 0.5 * box.max();
  const double half_diagonal = (0.5 * box.max() - 0.5 * box.min()).stableNorm();
  if (half_diagonal > 0) radius = half_diagonal;
  middle = 0.5 * scene.field.min + 0.5 * scene.field.max;
  const double half = 0.5 * scene.field.max - 0.5 * scene.field.min;
  if (half > 0) half_range = half;
}

Eigen::Vector3f Normalization::point(const Eigen::Vector3d& world) const {
  return ((world - center) / radius).cast<float>();
}

float Normalization::value(double value) const {
  // Far outside the range a value only has to stay there: its differences and products stay finite.
  return static_cast<float>(std::clamp((value - middle) / half_range, -1e30, 1e30));
}

}  // namespace tetraglass::project::gl
