#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads TetGen's files: NAME.node (points, with attributes as the point fields `attribute 0`, ...)
/// and, if it is there, NAME.ele (tetrahedra of 4 or 10 points, with attributes as cell fields
/// `region` or `region 0`, ...). Either name may be given. Points are counted from 0 or 1, as the
/// first one is. Without NAME.ele there are points only. Or a boundary: NAME.poly (facets of
/// several polygons, segments and holes, see `triangulate_facet`), NAME.smesh (of one polygon
/// each), NAME.face (triangles), with their points in the file itself or in NAME.node, and the
/// places of holes and regions (`marks`). Source: Si, TetGen manual, section "File formats". Throws
/// ReadError with the line.
[[nodiscard]] MeshData read_tetgen(const std::string& file);

}  // namespace tetraglass::mesh
