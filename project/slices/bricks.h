#pragma once

#include <cstddef>
#include <vector>

#include "mesh/rectilinear_grid.h"
#include "project/slices/grid_view.h"
#include "project/slices/shown_blocks.h"

namespace tetraglass::project::slices {

/// A part of a grid that has a texture of its own.
struct Brick {
  Block voxels;  ///< those that it draws
  Block points;  ///< those that its texture holds: the voxels' and a border around them
};

/// Cuts a grid into equal bricks, as few as halving finds, that hold at most `most_points` points
/// and `most_side` along an axis. The voxels of the bricks do not overlap and fill the grid.
/// `border`: the points beyond a brick's voxels, along each axis, that its slabs may reach. Throws
/// UnavailableError where not even one voxel fits.
[[nodiscard]] std::vector<Brick> make_bricks(const mesh::RectilinearGrid& grid,
                                             const Eigen::Vector3i& border, std::size_t most_points,
                                             int most_side);

/// Puts those first that others may hide: rays go away from the eye along every axis.
void order_bricks(std::vector<Brick>& bricks, const mesh::RectilinearGrid& grid,
                  const GridView& view);

}  // namespace tetraglass::project::slices
