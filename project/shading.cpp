#include "project/shading.h"

#include <algorithm>
#include <cmath>

namespace tetraglass::project {

preint::Color shade_headlight(const preint::Color& color, const Eigen::Vector3d& gradient,
                              const Eigen::Vector3d& to_viewer, const Material& material) {
  // Scaled by its largest component first: the square of a gradient may overflow or vanish.
  const double largest = gradient.cwiseAbs().maxCoeff();
  if (!(largest > 0) || !std::isfinite(largest)) return color;
  const double cosine = std::abs((gradient / largest).normalized().dot(to_viewer));
  // r.v = 2 (n.v)^2 - 1, the light standing where the viewer stands.
  const double reflected = std::max(0.0, 2 * cosine * cosine - 1);
  return color * (material.ambient + material.diffuse * cosine) +
         material.specular * std::pow(reflected, material.shininess);
}

}  // namespace tetraglass::project
