#pragma once

#include <string>
#include <vector>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// The largest hole that is closed unless asked for otherwise: the diagonal of the box around its
/// edge, over that around the surface.
inline constexpr double kUsualLargestHole = 0.1;

/// The surface of the cells of dimension 2, made fit to be filled as far as that is safe: equal
/// points joined, triangles that are there twice left out, triangles turned so that neighbours
/// agree (shells that lie in an odd number of others then bound cavities), the surface cut open
/// where more than two triangles meet and stitched where two edges match, triangles without area
/// removed (these three by CGAL on a halfedge structure of OpenMesh), and holes no larger than
/// `largest_hole` closed by triangles between the points of their edge (Liepa 2003, "Filling holes
/// in meshes"). No point is added or moved, so that point fields are kept; cell fields are not.
/// Intersections are not mended, larger holes not closed: filling the surface refuses those, saying
/// where. All that was done is added to `notes`, with counts. Throws InputError where coordinates
/// are not finite or the repair fails; UnavailableError in a build without CGAL.
[[nodiscard]] MeshData repair_surface(const MeshData& data, double largest_hole,
                                      std::vector<std::string>& notes);

}  // namespace tetraglass::mesh
