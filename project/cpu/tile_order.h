#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "project/cpu/drawn_cells.h"
#include "project/cpu/view_points.h"

namespace tetraglass::project::cpu {

/// Puts the cells of a tile in the order of their distances: of their centroids, of large cells of
/// what lies in the tile. Keeps its memory.
class TileOrder {
 public:
  /// The nearest first; in parallel views by depth. Distances are told apart to 2^-22 of the span
  /// from the nearest to the farthest; equal ones stay in their order. Cost: linear. Valid until
  /// the next call.
  [[nodiscard]] std::span<const std::uint32_t> front_to_back(std::span<const std::uint32_t> cells,
                                                             const DrawnCells& drawn,
                                                             const ViewPoints& points,
                                                             const Region& tile);

  [[nodiscard]] std::size_t bytes() const {
    return sizeof(float) * distances_.size() + sizeof(std::uint32_t) * cells_.size() +
           sizeof(Entry) * (entries_.size() + half_sorted_.size());
  }

 private:
  struct Entry {
    std::uint32_t key;
    std::uint32_t cell;
  };

  std::vector<float> distances_;
  std::vector<Entry> entries_;
  std::vector<Entry> half_sorted_;
  std::vector<std::uint32_t> cells_;
};

}  // namespace tetraglass::project::cpu
