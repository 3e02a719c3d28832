#pragma once

#include <string>
#include <vector>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads a VTK data set: the XML formats (.vtu .vti .vts .vtr .vtp and their parallel forms .pvtu
/// ...) and the legacy format (.vtk). Throws ReadError with VTK's own reason where a file is
/// damaged.
[[nodiscard]] MeshData read_vtk(const std::string& file);

}  // namespace tetraglass::mesh
