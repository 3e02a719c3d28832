#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads a mesh of Netgen (.vol): its volume and surface elements. The cell field `domain` has the
/// number of each volume element's domain (0 for surface elements), where they differ. Of elements
/// with points on their edges, tetrahedra keep them; of others the corners are used. Source:
/// Schöberl, Netgen 4 manual, and the elements' tables in its sources. Throws ReadError with the
/// line.
[[nodiscard]] MeshData read_netgen(const std::string& file);

}  // namespace tetraglass::mesh
