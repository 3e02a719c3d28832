#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads a view of Gmsh in text (.pos, 'View "NAME" { SS(x,y,z,...){v,...}; ... };'): tetrahedra,
/// hexahedra, prisms, pyramids, quadrilaterals, triangles, lines and points with scalars, vectors
/// or tensors at each corner, of the time step that `time` names (as in `find_time_step`; the times
/// are those of the list TIME, or 0, 1, ...). Corners of the same place and value become one point:
/// where values differ, the field jumps there and the cells are not linked. Of several views the
/// first one is read. Gmsh's language, of which such a file is a part, is not interpreted (it can
/// run other programs). Source: Gmsh reference manual, section "Legacy formats". Throws ReadError.
[[nodiscard]] MeshData read_pos(const std::string& file, const std::string& time);

}  // namespace tetraglass::mesh
