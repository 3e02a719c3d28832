#include "project/gl/normalization.h"

#include <algorithm>

namespace tetraglass::project::gl {

Normalization::Normalization(const Scene& scene) : values(scene.field) {
  // Halved before they are added or subtracted: numbers near the largest double must not overflow.
  const mesh::Box box = mesh::bounds(*scene.mesh);
  center = 0.5 * box.min() + 0.5 * box.max();
  const double half_diagonal = (0.5 * box.max() - 0.5 * box.min()).stableNorm();
  if (half_diagonal > 0) radius = half_diagonal;
}

Eigen::Vector3f Normalization::point(const Eigen::Vector3d& world) const {
  return ((world - center) / radius).cast<float>();
}

float modulation_factor(const Scene& scene, const Normalization& normalization) {
  const double steepness = (normalization.field_value(1) - normalization.field_value(0)) /
                           normalization.radius;  // of a gradient of 1
  return static_cast<float>(std::min(steepness / *scene.modulation, 1e30));
}

}  // namespace tetraglass::project::gl
