#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads a mesh in Medit's format, in text (.mesh) or binary (.meshb, versions 1 to 4, either byte
/// order), and, where it is there, the solution beside it (.sol, .solb of the same name; either
/// name may be given): values at vertices become point fields, those of tetrahedra cell fields
/// ("solution", or "solution 0", ...). The cell field `reference` has the references of the
/// elements, where those of the solids differ. Other sections are skipped. Source: Maréchal,
/// libMeshb handbook (INRIA 2019). Throws ReadError.
[[nodiscard]] MeshData read_medit(const std::string& file);

}  // namespace tetraglass::mesh
