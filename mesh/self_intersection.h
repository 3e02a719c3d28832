#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "mesh/triangle_surface.h"

namespace tetraglass::mesh {

/// What keeps a closed surface from having an inside; all decided exactly.
struct SurfaceFaults {
  std::size_t flat = 0;  ///< triangles whose corners lie on one line
  std::size_t crossings =
      0;  ///< pairs of triangles that meet elsewhere than in a common corner or edge
  Eigen::Vector3d where = Eigen::Vector3d::Zero();  ///< a corner of the first fault
};

/// Tests all pairs of triangles whose boxes meet. Cost: a sweep along the longest axis; n sqrt(n)
/// for n triangles of like size.
[[nodiscard]] SurfaceFaults find_faults(const TriangleSurface& surface);

}  // namespace tetraglass::mesh
