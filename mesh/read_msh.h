#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads Gmsh's mesh format (.msh) of the versions 2 and 4.1, in text or binary: all elements, and
/// node and element data at one time step (`time` as in `find_time_step`) as fields. The cell field
/// `physical` has the number of each element's first physical group (0 for none), where a solid has
/// one. Elements of high order without a VTK counterpart are reduced to their corners. Elements of
/// the same number are all kept. Files of other versions go to `read_gmsh`. Source: Gmsh reference
/// manual, section "MSH file format". Throws ReadError.
[[nodiscard]] MeshData read_msh(const std::string& file, const std::string& time);

}  // namespace tetraglass::mesh
