#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "mesh/triangle_surface.h"

namespace tetraglass::mesh {

/// What keeps a surface from having an inside; all decided exactly.
struct SurfaceFaults {
  std::size_t flat = 0;  ///< triangles whose corners lie on one line
  std::size_t crossings =
      0;  ///< pairs of triangles that meet elsewhere than in a common corner or edge
  std::vector<std::size_t> first_flat;                               ///< a few of those triangles
  std::vector<std::pair<std::size_t, std::size_t>> first_crossings;  ///< a few of those pairs
};

/// Tests all triangles, and all pairs of triangles with area whose boxes meet. Cost: a sweep along
/// the longest axis; n sqrt(n) for n triangles of like size.
[[nodiscard]] SurfaceFaults find_faults(const TriangleSurface& surface);

}  // namespace tetraglass::mesh
