#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// The names that `make_sample` knows.
[[nodiscard]] std::vector<std::string> sample_names();

/// A test mesh with a known field. `orbital` and `sphere`: n^3 points, each voxel split into 5 tetrahedra (alternating, so that
/// neighbours share diagonals); weiler2002's data sets have n = 32: 148,955 cells. `cells` > 0 takes the n whose cell count
/// 5 (n - 1)^3 comes nearest; 0 means n = 32. The point field is named as the sample.
/// `sphere`: over [-1, 1]^3, the distance from the origin. `orbital`: over [-1, 1]^3, the density of a hydrogen-like 3d_z2 or
/// 4f orbital, scaled to [0, 1].
/// Throws UsageError for an unknown name, with the nearest ones.
[[nodiscard]] TetMesh make_sample(const std::string& name, std::size_t cells = 0);

}  // namespace tetraglass::mesh
