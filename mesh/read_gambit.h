#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads a neutral file of Gambit (.neu): its elements, of which those of higher order are reduced
/// to their corners where these come first. The cell field `group` has the number of each element's
/// group (0 for none), where there is more than one. Source: GAMBIT 2.3 User's Guide, appendix C,
/// "Neutral File Format". Throws ReadError with the line.
[[nodiscard]] MeshData read_gambit(const std::string& file);

}  // namespace tetraglass::mesh
