#pragma once

#include <array>
#include <vector>

#include "preint/transfer_function.h"
#include "project/cpu/drawn_cells.h"

namespace tetraglass::project::cpu {

/// An isosurface of a scene, as the kernels read it.
struct Surface {
  float value = 0;      ///< scaled
  float threshold = 0;  ///< ValueScale::isovalue_threshold
  float opacity = 1;
  std::array<float, 3> color = {};
  preint::Material material;
};

/// Those of the scene, the lowest first.
[[nodiscard]] std::vector<Surface> surfaces(const Scene& scene, const DrawnCells& cells);

}  // namespace tetraglass::project::cpu
