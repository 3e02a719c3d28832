#pragma once

#include <vector>

#include "project/scene.h"

namespace tetraglass::project {

/// What the extinction in each cell of the mesh is multiplied by, min(1, |gradient| / modulation):
/// boundaries show, homogeneous regions do not (meissner2002 section 2.3, where the extinction of a
/// cell is exact because its gradient is constant). The scene has a
/// modulation. All 0 for a cell field.
[[nodiscard]] std::vector<double> cell_densities(const Scene& scene);

}  // namespace tetraglass::project
