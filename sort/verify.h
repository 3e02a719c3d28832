#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tet_mesh.h"
#include "sort/cell_links.h"
#include "sort/order.h"

namespace tetraglass::sort {

/// How many faces between two cells of the order are drawn in the wrong order: the eye lies
/// strictly on the side of the cell that is drawn first. Decided exactly. In parallel.
struct FaceCheck {
  std::size_t faces = 0;  ///< that are not seen edge-on
  std::size_t wrong = 0;
};
[[nodiscard]] FaceCheck check_faces(const mesh::TetMesh& mesh, const CellLinks& links,
                                    std::span<const std::uint32_t> order, const View& view);

/// How many of `count` random rays meet two cells in the wrong order. A ray is checked against
/// every cell of the order, by brute force and exactly (floating point only sorts out cells whose
/// circumscribed ball it cannot meet): a ray is wrong if of two cells that it meets along pieces of
/// positive length, which do not overlap, the nearer one is drawn first. Rays go through random
/// points of random cells; the same `seed` gives the same rays. In parallel; cost: count x cells.
struct RayCheck {
  std::size_t rays = 0;
  std::size_t wrong = 0;
  std::size_t overlapping = 0;  ///< rays on which two cells overlap: the mesh is not sound there
  std::size_t pieces = 0;       ///< of rays in cells
};
[[nodiscard]] RayCheck check_rays(const mesh::TetMesh& mesh, std::span<const std::uint32_t> order,
                                  const View& view, std::size_t count, std::uint32_t seed = 1);

/// The same for the order `fragments` (fragments.h), in which each ray sorts its own pieces, by
/// depths in double.
[[nodiscard]] RayCheck check_fragments(const mesh::TetMesh& mesh,
                                       std::span<const std::uint32_t> cells, const View& view,
                                       std::size_t count, std::uint32_t seed = 1);

}  // namespace tetraglass::sort
