#include "project/slices/shown_blocks.h"

#include <algorithm>
#include <limits>

namespace tetraglass::project::slices {
namespace {

using Eigen::Vector3i;

int points(const mesh::RectilinearGrid& grid, int axis) {
  return static_cast<int>(grid.size(static_cast<std::size_t>(axis)));
}

/// Joins boxes that are neighbours along an axis and alike across it. Those of a row follow each
/// other in the list.
std::vector<Block> joined(std::vector<Block> blocks, int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const auto key = [&](const Block& b) {
    return std::array{b.low[u], b.high[u], b.low[v], b.high[v], b.low[axis]};
  };
  std::ranges::sort(blocks, {}, key);
  std::vector<Block> result;
  for (const Block& block : blocks) {
    if (!result.empty()) {
      Block& last = result.back();
      const bool alike = last.low[u] == block.low[u] && last.high[u] == block.high[u] &&
                         last.low[v] == block.low[v] && last.high[v] == block.high[v];
      if (alike && last.high[axis] == block.low[axis]) {
        last.high[axis] = block.high[axis];
        continue;
      }
    }
    result.push_back(block);
  }
  return result;
}

}  // namespace

BlockRanges::BlockRanges(const mesh::RectilinearGrid& grid, const std::vector<double>& values) {
  for (int k = 0; k < 3; ++k) {
    last_[k] = points(grid, k) - 1;
    count_[k] = (last_[k] + kSide - 1) / kSide;
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ranges_.assign(static_cast<std::size_t>(count_.x()) * static_cast<std::size_t>(count_.y()) *
                     static_cast<std::size_t>(count_.z()),
                 {kInfinity, -kInfinity});
  std::size_t point = 0;
  for (int z = 0; z <= last_.z(); ++z) {
    for (int y = 0; y <= last_.y(); ++y) {
      for (int x = 0; x <= last_.x(); ++x, ++point) {
        // All blocks that have it as a corner of a voxel, or within the border.
        const Vector3i at(x, y, z);
        const Vector3i low = ((at.array() - 1 - kBorder).max(0) / kSide).matrix();
        const Vector3i high = ((at.array() + kBorder) / kSide).min(count_.array() - 1).matrix();
        for (int k = low.z(); k <= high.z(); ++k) {
          for (int j = low.y(); j <= high.y(); ++j) {
            for (int i = low.x(); i <= high.x(); ++i) {
              auto& [least, most] = ranges_[place({i, j, k})];
              least = std::min(least, values[point]);
              most = std::max(most, values[point]);
            }
          }
        }
      }
    }
  }
}

std::size_t BlockRanges::place(const Vector3i& block) const {
  return (static_cast<std::size_t>(block.z()) * static_cast<std::size_t>(count_.y()) +
          static_cast<std::size_t>(block.y())) *
             static_cast<std::size_t>(count_.x()) +
         static_cast<std::size_t>(block.x());
}

bool BlockRanges::any(const Vector3i& block, const Vector3i& reach,
                      const std::function<bool(double, double)>& shows) const {
  const Vector3i blocks = ((reach.array() - kBorder).max(0) + kSide - 1) / kSide;
  const Vector3i low = (block - blocks).cwiseMax(0);
  const Vector3i high = (block + blocks).cwiseMin(count_ - Vector3i::Ones());
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (int z = low.z(); z <= high.z(); ++z) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        const auto& range = ranges_[place({x, y, z})];
        least = std::min(least, range[0]);
        most = std::max(most, range[1]);
      }
    }
  }
  return shows(least, most);
}

std::vector<Block> BlockRanges::shown(const Block& within, const Vector3i& reach,
                                      const std::function<bool(double, double)>& shows) const {
  std::vector<Block> blocks;
  for (int z = within.low.z() / kSide; z * kSide < within.high.z(); ++z) {
    for (int y = within.low.y() / kSide; y * kSide < within.high.y(); ++y) {
      for (int x = within.low.x() / kSide; x * kSide < within.high.x(); ++x) {
        const Vector3i at(x, y, z);
        if (!any(at, reach, shows)) continue;
        blocks.push_back({(at * kSide).cwiseMax(within.low),
                          ((at + Vector3i::Ones()) * kSide).cwiseMin(within.high)});
      }
    }
  }
  for (int axis = 0; axis < 3; ++axis) blocks = joined(std::move(blocks), axis);
  return blocks;
}

Block whole_grid(const mesh::RectilinearGrid& grid) {
  return {Vector3i::Zero(), {points(grid, 0) - 1, points(grid, 1) - 1, points(grid, 2) - 1}};
}

GridBox box_of(const Block& block, const mesh::RectilinearGrid& grid) {
  GridBox box;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const std::vector<double>& row = grid.coordinates[k];
    box.low[axis] = 2 * row[static_cast<std::size_t>(block.low[axis])] / row.back() - 1;
    box.high[axis] = 2 * row[static_cast<std::size_t>(block.high[axis])] / row.back() - 1;
  }
  return box;
}

}  // namespace tetraglass::project::slices
