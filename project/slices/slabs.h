#pragma once

#include <array>
#include <vector>

#include "project/gl/normalization.h"
#include "project/slices/grid_view.h"
#include "project/slices/outline.h"
#include "project/slices_plan.h"

namespace tetraglass::project::slices {

/// What lies between two neighbouring surfaces of the family that cuts the rays (Stack).
struct Slab {
  /// What grid_ray.glsl cuts rays at: ray parameters of planes; distances from the eye less `focus`
  /// of shells; places along the stack's axis (units of half extents) of textures. Neighbours share
  /// one, to the last bit.
  std::array<float, 2> bounds{};
  Depths depths;    ///< it lies between these
  double low = -1;  ///< of textures: the part of the stack's axis
  double high = 1;
};

/// All slabs that a frame can see of the grid, the farthest first. Surfaces lie `distance` apart,
/// one of them in the middle of the grid; the slabs of Stack::textures without a distance are
/// centred at the planes of the grid. `distance` is in units of the normalization.
[[nodiscard]] std::vector<Slab> make_slabs(const GridView& view, const mesh::RectilinearGrid& grid,
                                           Stack stack, double distance);

}  // namespace tetraglass::project::slices
