#pragma once

#include <cstdint>
#include <vector>

#include "project/scene.h"
#include "project/value_scale.h"

namespace tetraglass::project::cpu {

/// The cells of a scene that can show anything, as the kernels read them; what no view changes.
struct DrawnCells {
  /// Takes those of `shown_cells`.
  explicit DrawnCells(const Scene& scene);

  [[nodiscard]] std::size_t size() const { return vertices.size(); }

  ValueScale scale;

  /// Four point indices, ascending: both cells at a face then do the same arithmetic with the same
  /// numbers, and agree on it to the last bit.
  std::vector<mesh::Cell> vertices;

  std::vector<std::uint32_t> numbers;  ///< in the mesh

  /// 1 where ascending order turns the cell inside out, else 0.
  std::vector<std::uint8_t> mirrored;

  std::vector<float> point_values;  ///< scaled; empty for a cell field
  std::vector<float> cell_values;   ///< scaled, of each drawn cell; empty for a point field
};

}  // namespace tetraglass::project::cpu
