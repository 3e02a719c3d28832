#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"

namespace tetraglass::project::gl {

/// What cells that are drawn at once may take, and what each of them and of their points takes.
struct PartLimits {
  std::size_t bytes = 0;   ///< of cells and points together
  std::size_t cells = 0;   ///< as many at most
  std::size_t points = 0;  ///< as many at most
  std::size_t cell_bytes = 0;
  std::size_t point_bytes = 0;
};

/// Cuts cells to draw, in whatever order, into runs that fit into limited memory, each with the
/// points that it has. Keeps a number for each point of the mesh.
class CellCutter {
 public:
  /// The mesh outlives it.
  CellCutter(const mesh::TetMesh& mesh, const PartLimits& limits);

  /// How many of `cells` (there is one), from the first on, fit together: the next part. Throws
  /// UnavailableError where not even one cell does. Cost: linear in the part, but for the sorting
  /// of its points.
  [[nodiscard]] std::size_t next(std::span<const std::uint32_t> cells);

  /// The points of the part's cells: their numbers in the mesh, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& points() const { return points_; }

  /// Where a point of the part is among them.
  [[nodiscard]] std::uint32_t place(std::uint32_t point) const { return places_[point]; }

 private:
  const mesh::TetMesh& mesh_;
  PartLimits limits_;
  std::vector<std::uint32_t> points_;
  std::vector<std::uint32_t> places_;
};

}  // namespace tetraglass::project::gl
