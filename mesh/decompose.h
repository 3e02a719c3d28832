#pragma once

#include <cstddef>

#include "mesh/mesh_data.h"
#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

struct Decomposition {
  TetMesh mesh;
  std::size_t skipped = 0;   ///< cells of dimension < 3
  std::size_t unknown = 0;   ///< cells of a type that cannot be split
  std::size_t inverted = 0;  ///< input tetrahedra and split cells that were negatively oriented, counted as tetrahedra, now turned
  std::size_t nonlinear = 0; ///< cells of higher order, drawn by their corners
};

/// Splits every cell of dimension 3 into tetrahedra. A quadrilateral face is cut by the diagonal through its smallest point
/// index, so that neighbours agree whatever their types (Dompierre et al. 1999, "How to subdivide pyramids, prisms and
/// hexahedra into tetrahedra"). Hexahedra give 5 or 6 tetrahedra, wedges 3, pyramids 2. Cells of higher order are reduced to
/// their corners. Polyhedra and prisms of more sides are starred from an added point at the mean of their points (point fields are averaged
/// there). Cell fields are copied to each part; points that no tetrahedron uses are dropped. Cells without volume are kept.
/// Throws InputError where there is no cell of dimension 3 or an index lies outside the points.
[[nodiscard]] Decomposition decompose(const MeshData& data);

}  // namespace tetraglass::mesh
