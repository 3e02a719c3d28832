#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads a CGNS file (.cgns, .cgn; HDF5 inside) by VTK: its zones, structured or not, as one mesh
/// with their solutions at vertices and in cells, of one time step (`time` as in `find_time_step`),
/// see `append_meshes`. In a process of its own, since VTK 9.1 trusts the sizes in such files.
/// Throws ReadError.
[[nodiscard]] MeshData read_cgns(const std::string& file, const std::string& time);

}  // namespace tetraglass::mesh
