#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace tetraglass::sort {

/// Where the eye is. Perspective: a point; parallel: all rays run along `direction` (away from the
/// viewer).
struct View {
  bool parallel = false;
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  ///< unit length
};

/// Cells in the order to draw them, farthest first, and what that order guarantees.
///
/// An order is exact if on every ray that starts at the eye (parallel: on every ray along the
/// direction) of two cells that the ray meets along a piece of positive length each, and that do
/// not overlap there, the farther one comes first.
struct Order {
  std::vector<std::uint32_t> cells;
  std::string method;
  bool exact = false;
  std::size_t cycles = 0;  ///< sets of cells that hide each other in a ring: no order is exact then
  std::vector<std::uint32_t> cyclic_cells;  ///< the cells of these sets
};

}  // namespace tetraglass::sort
