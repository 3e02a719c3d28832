#pragma once

#include <cstdint>
#include <vector>

#include "project/scene.h"
#include "project/value_scale.h"

namespace tetraglass::project::cpu {

/// The pixels [first, last] each way that something can touch; none where first > last.
struct PixelBounds {
  std::uint16_t first_x = 1;
  std::uint16_t first_y = 1;
  std::uint16_t last_x = 0;
  std::uint16_t last_y = 0;

  [[nodiscard]] bool empty() const { return first_x > last_x; }
};

/// A cell as tiles read it, in any order: half a line of the cache.
struct alignas(32) DrawnCell {
  /// Point indices, ascending: both cells at a face then do the same arithmetic with the same
  /// numbers, and agree on it to the last bit.
  mesh::Cell vertices;
  PixelBounds bounds;     ///< in the view in work (see TileBins)
  float distance = 0;     ///< in this view: the mean of those of its vertices
  bool mirrored = false;  ///< ascending order turns the cell inside out
};

struct DrawnCells;

/// Numbers of drawn cells by their largest values: roughly, in 64 steps, the highest first; cells
/// of a step in their own order, neighbours near each other. In parallel; cost: linear.
[[nodiscard]] std::vector<std::uint32_t> highest_first(const DrawnCells& cells);

/// The cells of a scene that can show anything, as the kernels read them.
struct DrawnCells {
  /// Takes those of `shown_cells`.
  explicit DrawnCells(const Scene& scene);

  /// The same of another field or transfer function on the same mesh; the cells themselves are read
  /// again only where others are shown.
  void update(const Scene& scene);

  [[nodiscard]] std::size_t size() const { return cells.size(); }

  ValueScale scale;

  std::vector<DrawnCell> cells;
  std::vector<std::uint32_t> numbers;  ///< in the mesh

  std::vector<float> point_values;  ///< scaled; empty for a cell field
  std::vector<float> cell_values;   ///< scaled, of each drawn cell; empty for a point field
  /// What the extinction of each drawn cell is multiplied by; empty without modulation.
  std::vector<float> densities;
};

}  // namespace tetraglass::project::cpu
