#pragma once

#include "mesh/predicates.h"
#include "sort/order.h"

namespace tetraglass::sort {

/// Decided exactly: 1 if the eye of `view` lies on the side of the plane through a, b and c from
/// which they are seen counter-clockwise, -1 if on the other side, 0 if in the plane. Of a face
/// with its vertices in the order of kFaceVertices, 1 says that rays enter the cell there, -1 that
/// they leave it.
[[nodiscard]] inline int eye_side(const View& view, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return view.parallel ? -mesh::orientation_towards(a, b, c, view.direction)
                       : mesh::orientation(a, b, c, view.eye);
}

}  // namespace tetraglass::sort
