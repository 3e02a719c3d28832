#pragma once

#include <string>
#include <vector>

#include "mesh/mesh_data.h"
#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// Carries the point fields of a surface over to the tetrahedra that fill it: points on the
/// boundary of `mesh` take the value of the surface at its nearest place (their own where they are
/// points of it), those within the harmonic interpolation: the solution of Laplace's equation by
/// linear finite elements, which has no extrema inside up to the error of the elements. Values that
/// are not finite stay where they are on the surface and count as the mean of the others within.
/// What was done is added to `notes`. Cost: a conjugate-gradient solve per component, tolerance
/// 1e-8.
void carry_surface_fields(const MeshData& surface, TetMesh& mesh, std::vector<std::string>& notes);

}  // namespace tetraglass::mesh
