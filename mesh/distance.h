#pragma once

#include <vector>

#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// The distance of every point to the nearest boundary triangle of the mesh (a face with one cell,
/// or with more than two), in the mesh's units: exactly 0 at boundary points, and at points that no
/// cell uses or whose coordinates are not finite. One per point. In parallel. Cost: a bounding
/// volume hierarchy over the boundary, then about log(boundary) per point.
[[nodiscard]] std::vector<double> boundary_distance(const TetMesh& mesh);

}  // namespace tetraglass::mesh
