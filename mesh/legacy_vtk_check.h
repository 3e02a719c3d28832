#pragma once

#include <string>

namespace tetraglass::mesh {

/// Checks what VTK's reader of its legacy format takes on trust, up to the fields: that the file
/// has the values it claims, and that the lists of cells agree with their sizes (where they do not,
/// VTK 9.1 reads and writes beyond its arrays). Throws ReadError. What it does not know is left to
/// VTK.
void check_legacy_vtk(const std::string& file);

}  // namespace tetraglass::mesh
