#pragma once

#include <Eigen/Core>

#include "preint/transfer_function.h"

namespace tetraglass::project {

/// Phong coefficients of a surface (meissner2002 Eq. 1).
struct Material {
  double ambient = 0.1;
  double diffuse = 0.7;
  double specular = 0.2;
  double shininess = 32;
};

/// The color of a surface point under a white headlight (a light at the viewer, l = v) and white
/// ambient light: k_a c + k_d c (n.v) + k_s max(0, r.v)^shininess with n turned towards the viewer
/// and r = 2 (n.v) n - v. `gradient` need not be of unit length; where it is zero the color is
/// unshaded. `to_viewer` has unit length. project/gl/shade.glsl says the same.
[[nodiscard]] preint::Color shade_headlight(const preint::Color& color,
                                            const Eigen::Vector3d& gradient,
                                            const Eigen::Vector3d& to_viewer,
                                            const Material& material = {});

}  // namespace tetraglass::project
