#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/tet_mesh.h"

namespace tetraglass::sort {

/// Which of the cells to be sorted have volume (decided exactly), and which of these meet at a
/// face, one on each side. What two cells on the same side share (doubled cells, folds) is no such
/// face, nor is one with a cell without volume: they are left as boundary faces.
struct CellLinks {
  std::vector<std::uint32_t> cells;  ///< with volume, ascending
  std::vector<std::uint32_t> flat;   ///< without, ascending
  mesh::Adjacency adjacency;         ///< between `cells` only; of other cells meaningless
};

/// `cells` are indices into mesh.cells of cells with finite coordinates. In parallel.
[[nodiscard]] CellLinks link_cells(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells);

}  // namespace tetraglass::sort
