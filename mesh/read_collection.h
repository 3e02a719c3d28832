#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads a collection of ParaView (.pvd: files by time step and part) or of VTK (.vtm: blocks of
/// files), both in XML: the files of one time step (`time` as in `find_time_step`) as one mesh, see
/// `append_meshes`. Files are named from the folder of the collection, and have the formats of
/// `read_vtk`. Throws ReadError.
[[nodiscard]] MeshData read_collection(const std::string& file, const std::string& time);

}  // namespace tetraglass::mesh
