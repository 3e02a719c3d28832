#include "project/gl/normalization.h"

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

}  // namespace tetraglass::project::gl
