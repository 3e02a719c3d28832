#pragma once

#include <array>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "mesh/rectilinear_grid.h"
#include "project/slices/grid_view.h"

namespace tetraglass::project::slices {

/// Some of a grid's voxels: from the point `low` to the point `high`.
struct Block {
  Eigen::Vector3i low = Eigen::Vector3i::Zero();
  Eigen::Vector3i high = Eigen::Vector3i::Zero();
};

/// The values of a grid, summed up by blocks of voxels: what tells which of them show nothing.
class BlockRanges {
 public:
  /// Voxels of a block each way; fewer at the grid's end.
  static constexpr int kSide = 16;

  /// Points beyond a block that are summed up with it.
  static constexpr int kBorder = 2;

  /// `values`: one for each point, all finite. Cost: linear.
  BlockRanges(const mesh::RectilinearGrid& grid, const std::vector<double>& values);

  /// Boxes that do not overlap and hold every place of `within` around which, not farther than
  /// `reach` points along each axis, the field has values [least, most] that `shows` does not say
  /// to be empty. As few as joining neighbours finds.
  [[nodiscard]] std::vector<Block> shown(const Block& within, const Eigen::Vector3i& reach,
                                         const std::function<bool(double, double)>& shows) const;

 private:
  [[nodiscard]] bool any(const Eigen::Vector3i& block, const Eigen::Vector3i& reach,
                         const std::function<bool(double, double)>& shows) const;
  [[nodiscard]] std::size_t place(const Eigen::Vector3i& block) const;

  Eigen::Vector3i count_;  // of blocks
  Eigen::Vector3i last_;   // points
  std::vector<std::array<double, 2>> ranges_;
};

/// All voxels.
[[nodiscard]] Block whole_grid(const mesh::RectilinearGrid& grid);

/// The block in units of the grid's half extents.
[[nodiscard]] GridBox box_of(const Block& block, const mesh::RectilinearGrid& grid);

}  // namespace tetraglass::project::slices
