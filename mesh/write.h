#pragma once

#include <string>

#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// Writes the mesh with all its fields in double as a VTK XML unstructured grid (.vtu, compressed,
/// 64-bit headers). The file appears whole or not at all. Throws WriteError (also for another
/// extension).
void write_vtu(const TetMesh& mesh, const std::string& file);

}  // namespace tetraglass::mesh
