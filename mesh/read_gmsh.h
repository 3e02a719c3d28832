#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads any mesh that Gmsh's library reads: all
/// elements, and the node and element data of its views at one time step (`time` as in
/// `find_time_step`) as fields; the cell field `physical` has the number of the physical volume,
/// where there are any. Elements of high order without a VTK counterpart are reduced to their
/// corners. Throws ReadError; UnavailableError in a build without Gmsh.
[[nodiscard]] MeshData read_gmsh(const std::string& file, const std::string& time);

}  // namespace tetraglass::mesh
