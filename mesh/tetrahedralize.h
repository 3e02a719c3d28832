#pragma once

#include <string>
#include <vector>

#include "mesh/mesh_data.h"
#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// How many tetrahedra a filled surface gets unless asked for: enough to see the inside of its
/// field, few enough to be drawn at once.
inline constexpr double kUsualCells = 1e5;

/// Fills the closed surface that the cells of dimension 2 of `data` make with about `cells`
/// well-shaped tetrahedra (more where the surface is finer), by TetGen. Equal points are
/// one; polygons are cut by the diagonals from their smallest point index. A shell within another
/// one is a cavity if its faces turn towards its inside, and part of the solid if they turn away
/// from it; where the faces of a surface do not agree on a direction, shells that lie in an odd
/// number of others are cavities. Points are added within (a regular lattice), and on the surface
/// where its triangles are large for that; fields are not carried over. What was done is added to
/// `notes`. Throws InputError for a surface that is open (with the number of its open edges), has
/// no volume, or intersects itself; UnavailableError in a build without TetGen. Source: Si 2015,
/// "TetGen, a Delaunay-Based Quality Tetrahedral Mesh Generator".
[[nodiscard]] TetMesh fill_surface(const MeshData& data, std::vector<std::string>& notes,
                                   double cells = kUsualCells);

/// The Delaunay tetrahedra of all points, which fill their convex hull, with the point fields. Of
/// equal points the first one counts. What was done is added to `notes`. Throws InputError for
/// fewer than 4 points, points in one plane and coordinates that are not finite; UnavailableError
/// in a build without CGAL.
[[nodiscard]] TetMesh delaunay(const MeshData& data, std::vector<std::string>& notes);

}  // namespace tetraglass::mesh
