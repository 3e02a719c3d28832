#pragma once

#include <optional>

#include <Eigen/Core>

#include "preint/transfer_function.h"
#include "project/light/lights.h"

namespace tetraglass::project {

/// Light that reaches a point of a surface, before its color and material: the ambient light, the
/// sum of color max(0, n.l) over the lights and that of color max(0, r.v)^shininess, with r =
/// 2 (n.l) n - l (meissner2002 Eq. 1).
struct Illumination {
  preint::Color ambient = preint::Color::Ones();
  preint::Color diffuse = preint::Color::Zero();
  preint::Color specular = preint::Color::Zero();

  /// k_a c ambient + k_d c diffuse + k_s specular.
  [[nodiscard]] preint::Color shade(const preint::Color& color,
                                    const preint::Material& material) const {
    return color * (material.ambient * ambient + material.diffuse * diffuse) +
           material.specular * specular;
  }
};

/// In double precision. Without lights by a headlight: white light at the viewer, l = v, and white
/// ambient light. All vectors in the mesh's axes; `normal` and `to_viewer` have unit length; the
/// side of the surface that is turned to the viewer is lit. A light at the point itself does not
/// light it. Rectangles are integrated to 1e-5 of their color.
[[nodiscard]] Illumination illuminate(const std::optional<Lights>& lights,
                                      const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                                      const Eigen::Vector3d& to_viewer, double shininess);

/// The color of a point under the lights. `gradient` is its normal, of any length; where it is zero
/// the color is unshaded.
[[nodiscard]] preint::Color shade(const std::optional<Lights>& lights, const preint::Color& color,
                                  const preint::Material& material, const Eigen::Vector3d& point,
                                  const Eigen::Vector3d& gradient,
                                  const Eigen::Vector3d& to_viewer);

}  // namespace tetraglass::project
