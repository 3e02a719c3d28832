#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads an Exodus II file: the cells of all element blocks together, and the nodal and element
/// variables at one time step. `time`: "" or "last", a time value (the nearest step is taken), or
/// "index:N" counted from 0. Variables named as the components of a vector (V_X, V_Y, V_Z, or VX,
/// VY, VZ) become one field; where a block lacks an element variable its cells have NaN. A file
/// with several blocks has the cell field `block` with their numbers. Coordinates are not
/// displaced. Source: Schoof and Yarberry 1994, "EXODUS II: A Finite Element Data Model",
/// SAND92-2137. Throws ReadError.
[[nodiscard]] MeshData read_exodus(const std::string& file, const std::string& time);

}  // namespace tetraglass::mesh
