#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "project/gl/view_uniforms.h"
#include "project/slices/grid_view.h"

namespace tetraglass::project::slices {

/// Depths in camera space.
struct Depths {
  double near = 0;
  double far = 0;
};

/// A convex polygon on the tile, in pixels from its corner, that covers the image of the part of a
/// parallelepiped (its corners as GridView::corners has them) between two depths, and `margin`
/// pixels more each way; cut at a pixel outside the tile. Empty where nothing of it can be seen;
/// the whole tile where it surrounds the eye.
[[nodiscard]] std::vector<Eigen::Vector2d> outline(const GridView& view,
                                                   const std::array<Eigen::Vector3d, 8>& corners,
                                                   const Depths& depths, const gl::Tile& tile,
                                                   double margin);

}  // namespace tetraglass::project::slices
