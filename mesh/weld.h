#pragma once

#include <cstddef>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

struct Welding {
  std::size_t merged = 0;     ///< points that became one with another
  std::size_t collapsed = 0;  ///< cells that name too few different points after it: left out
};

/// Makes points one that lie within `distance` of each other (0: that are equal). Points are gone
/// through in their order: one that is near to a point kept before, the first of these, takes its
/// place, so that points kept lie farther apart than that, and none moves farther. The kept point's
/// values count. Cells that collapse (simplices that name a corner twice, others of dimension d
/// with fewer than d + 1 different points) are left out with their values. Points whose coordinates
/// are not finite are kept. Cost: linear on average.
[[nodiscard]] Welding weld(MeshData& data, double distance);

/// How many points no cell names.
[[nodiscard]] std::size_t unused_points(const MeshData& data);

}  // namespace tetraglass::mesh
