#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads the nodes and elements of an input file of Abaqus (.inp) of one part at most: solids
/// (C3D4, C3D5, C3D6, C3D8, C3D10, C3D15, C3D20 and their variants), shells, membranes, trusses and
/// beams; elements of other types are left out, which is noted. Other keywords are skipped. Source:
/// Abaqus Keywords Reference Guide, "*NODE", "*ELEMENT". Throws ReadError with the line.
[[nodiscard]] MeshData read_abaqus(const std::string& file);

}  // namespace tetraglass::mesh
