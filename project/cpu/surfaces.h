#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "project/cpu/drawn_cells.h"
#include "project/shading.h"

namespace tetraglass::project::cpu {

/// The isosurfaces of a scene, as the kernels read them.
struct Surfaces {
  explicit Surfaces(const Scene& scene, const DrawnCells& cells);

  struct Surface {
    float value = 0;  ///< scaled
    float opacity = 1;
    std::array<float, 3> color = {};
  };

  std::vector<Surface> surfaces;
  Shading shading;
  Material material;
  /// Of each point (smooth) or each drawn cell (flat), in the mesh's axes, the largest component of
  /// all 1; empty without shading.
  std::vector<Eigen::Vector3d> gradients;
};

}  // namespace tetraglass::project::cpu
