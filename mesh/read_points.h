#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Whether a file is a list of points in text: all its lines (but remarks from # on, and one line
/// of names before the first point) have the same number of words, at least three, and these are
/// numbers. Grids of PLOT3D in text, which may look so too, are told by their head: it claims
/// exactly the numbers that follow it.
[[nodiscard]] bool is_point_list(const std::string& file);

/// Reads points from a text with a line for each: x, y, z, and values that become point fields
/// ("column 3", ..., or as the line of names says), between spaces or commas. Throws ReadError with
/// the line.
[[nodiscard]] MeshData read_points(const std::string& file);

}  // namespace tetraglass::mesh
