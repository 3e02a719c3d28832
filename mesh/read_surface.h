#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads a surface: Object File Format (.off, in text; the prefixes ST, C, N, 4, n do not matter
/// but for the number of coordinates), Wavefront (.obj; faces and lines of points, without
/// materials), stereolithography (.stl, in text or binary; equal corners become one point) or .ply.
/// Coordinates are read in double and faces are kept as they are, whether or not they make a
/// manifold. (OpenMesh 9.0 reads these formats too, but rounds coordinates to float, splits points
/// where faces are not manifold, invents points for indices out of range and ends the program on a
/// header that lies.) A file without faces is a cloud of points. Throws ReadError with the line, or
/// the number of the entry in a binary file.
[[nodiscard]] MeshData read_surface(const std::string& file);

/// Reads a polygon file (.ply), text or binary of either byte order, with the scalar properties of
/// its vertices as point fields. Source: Turk 1994, "The PLY Polygon File Format". Throws
/// ReadError.
[[nodiscard]] MeshData read_ply(const std::string& file);

}  // namespace tetraglass::mesh
