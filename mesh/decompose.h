#pragma once

#include <cstddef>
#include <map>

#include "mesh/mesh_data.h"
#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

struct Decomposition {
  TetMesh mesh;
  std::size_t skipped = 0;   ///< cells of dimension < 3
  std::size_t unknown = 0;   ///< cells of a type that cannot be split
  std::size_t inverted = 0;  ///< tetrahedra (of the input, or parts of a cell) that were negatively
                             ///< oriented and have been turned
  std::size_t collapsed = 0;                  ///< parts of a cell that name a point twice, left out
  std::map<CellType, std::size_t> nonlinear;  ///< cells of higher order, reduced to their corners
};

/// Splits every cell of dimension 3 into tetrahedra. A face with more than three points is cut by
/// the diagonals through its smallest point index, so that neighbours agree whatever their types
/// (Dompierre et al. 1999, "How to subdivide pyramids, prisms and hexahedra into tetrahedra").
/// Hexahedra and voxels give 5 or 6 tetrahedra, wedges 3, pyramids 2. Cells of higher order are
/// reduced to their corners. Polyhedra and prisms of more sides are starred from an added point at
/// the mean of their points (point fields are averaged there); their parts are turned without being
/// counted as inverted, for files do not agree on the direction of their faces.
///
/// Cell fields are copied to each part; points that no tetrahedron uses are dropped, the others
/// keep their order. Tetrahedra without volume are kept, and so is every tetrahedron of the input.
/// Parts that name a point twice (of a hexahedron collapsed to a wedge, say) are left out: they lie
/// in a face of the cells on both sides of it, which would no longer be linked.
///
/// Throws InputError where there is no cell of dimension 3, an index lies outside the points, a
/// cell has the wrong number of points or a field the wrong number of values. Cost: linear.
[[nodiscard]] Decomposition decompose(const MeshData& data);

}  // namespace tetraglass::mesh
