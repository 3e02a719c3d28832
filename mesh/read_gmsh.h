#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads a mesh by Gmsh's library (Nastran .bdf and .nas, I-deas .unv, .msh), in a
/// process of its own, since that ends or crashes on some damaged files: all elements, and the node
/// and element data of its views at one time step (`time` as in `find_time_step`) as fields; the
/// cell field `physical` has the number of the physical volume, where there are any. Elements of
/// high order without a VTK counterpart are reduced to their corners. An extension in capitals is
/// refused. Throws ReadError; UnavailableError in a build without Gmsh.
[[nodiscard]] MeshData read_gmsh(const std::string& file, const std::string& time);

}  // namespace tetraglass::mesh
