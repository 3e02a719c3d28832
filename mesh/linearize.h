#pragma once

#include <cstddef>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

struct Linearization {
  MeshData mesh;           ///< no cells of higher order but those that cannot be cut
  std::size_t cut = 0;     ///< cells that have been
  std::size_t pieces = 0;  ///< linear cells that they became
  std::size_t added = 0;   ///< points that have been added
};

/// Cuts cells of higher order into linear ones along their points, so that the value at each of
/// these is kept: Lagrange tetrahedra of order n into n^3 tetrahedra, Lagrange hexahedra and wedges
/// of orders p, q, r (equal ones, or as the cell field HigherOrderDegrees says) into p q r pieces;
/// and, with `quadratic`, quadratic tetrahedra into 8 tetrahedra, hexahedra (of 20, 24 and 27
/// points) and wedges (15, 18) into 8 pieces, wedges that are linear along their axis (12) into 4,
/// pyramids (13, 19) into 6 pyramids and 4 tetrahedra. Where quadratic cells lack the points in the
/// middle of their quadrilaterals and of hexahedra these are added, with the place and the values
/// that the shape functions give (Zienkiewicz and Taylor 2000, "The Finite Element Method", vol. 1,
/// ch. 8); neighbours share them, and take those of a neighbour that has them. The points within
/// the triangles of pyramids of 19 points and in their middle go unused, for the quadratic
/// triangles of neighbours have none. All other cells stay as they are, in order (Lagrange
/// pyramids, whose points VTK leaves unnumbered, and Bezier cells, whose points do not lie on
/// them); the pieces take the place of their cell, with its cell fields. A mesh without such cells
/// comes back untouched.
///
/// Throws InputError where a cell has a number of points that its type cannot have, or names points
/// that are not there. Cost: linear.
[[nodiscard]] Linearization linearize(MeshData data, bool quadratic);

}  // namespace tetraglass::mesh
