#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// The names that `make_sample` knows.
[[nodiscard]] std::vector<std::string> sample_names();

/// A test mesh with a known field; the point field is named as the sample. All over [-1, 1]^3:
/// - `orbital`: the density of the 4f_z(x2-y2) orbital, eight lobes:
///   (z (x^2 - y^2))^2 exp(-16 r), scaled so that its maximum over space is 1;
/// - `sphere`: the distance from the origin;
/// - `linear`: 0.5 + (x + 2 y + 3 z) / 12, from 0 to 1.
///
/// These three have n^3 points, each voxel split into 5 tetrahedra (alternating, so that neighbours
/// share diagonals); weiler2002's data sets have n = 32: 148,955 cells. `cells` > 0 takes the n
/// whose cell count 5 (n - 1)^3 comes nearest; 0 means n = 32. In parallel. Throws UsageError for
/// an unknown name, with the nearest ones, and for more points than 32-bit indices can number.
[[nodiscard]] TetMesh make_sample(const std::string& name, std::size_t cells = 0);

}  // namespace tetraglass::mesh
