#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "project/cpu/drawn_cells.h"
#include "project/cpu/view_points.h"

namespace tetraglass::project::cpu {

/// The pixels whose centres a cell can cover; no bounds ("all of the picture") to the sides where
/// it passes through the plane of the eye, and none for a cell behind the eye.
[[nodiscard]] PixelBounds pixel_bounds(const mesh::Cell& cell, const ViewPoints& points, int width,
                                       int height);

/// Which cells each square tile of the picture has to draw. Keeps its memory from view to view.
class TileBins {
 public:
  /// Bins all cells, in parallel, and sets their bounds and distances; each tile gets its cells in
  /// the given order, or, without one, in their own, whatever the number of threads. Cells that
  /// cover no pixel centre are left out. Cost: linear in cells and entries.
  void assign(DrawnCells& cells, const ViewPoints& points, int width, int height, int tile_size,
              std::span<const std::uint32_t> order = {});

  [[nodiscard]] std::size_t tiles() const { return tiles_x_ * tiles_y_; }
  [[nodiscard]] std::size_t bytes() const {
    return sizeof(std::uint32_t) * (counts_.size() + entries_.size()) +
           sizeof(std::size_t) * starts_.size();
  }
  [[nodiscard]] std::size_t tiles_x() const { return tiles_x_; }
  [[nodiscard]] std::span<const std::uint32_t> cells(std::size_t tile) const {
    return std::span(entries_).subspan(starts_[tile], starts_[tile + 1] - starts_[tile]);
  }

  /// The tiles with cells, those with the most first: what to hand out to threads.
  [[nodiscard]] std::vector<std::uint32_t> largest_first() const;

 private:
  std::size_t tiles_x_ = 0;
  std::size_t tiles_y_ = 0;
  std::vector<std::uint32_t> counts_;   // [chunk of cells][tile]
  std::vector<std::size_t> starts_;     // of each tile in entries_, and the end
  std::vector<std::uint32_t> entries_;  // cells
};

}  // namespace tetraglass::project::cpu
