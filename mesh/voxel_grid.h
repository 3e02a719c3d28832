#pragma once

#include <functional>
#include <vector>

#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// The points (axis[i], axis[j], axis[k]), i fastest, and their voxels, each split into 5
/// tetrahedra, alternating so that neighbours share diagonals; no fields. `axis` increases; two
/// values at least. In parallel.
[[nodiscard]] TetMesh make_voxel_grid(const std::vector<double>& axis);

/// Of a mesh from `make_voxel_grid`: leaves out the voxels whose centre `keep` denies, and the
/// points that no other voxel uses. The mesh must have no fields yet.
void keep_voxels(TetMesh& mesh, const std::function<bool(const Eigen::Vector3d& center)>& keep);

}  // namespace tetraglass::mesh
