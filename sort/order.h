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
struct Order {
  std::vector<std::uint32_t> cells;
  std::string method;
  bool exact = false;
  std::size_t cycles = 0;
};

}  // namespace tetraglass::sort
