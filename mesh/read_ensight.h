#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads a case of EnSight 6 or Gold (.case, .encas; text or binary) by VTK: its parts as one mesh
/// with the variables of one time step (`time` as in `find_time_step`), see `append_meshes`. In a
/// process of its own, since VTK 9.1 trusts the sizes in such files. Throws ReadError.
[[nodiscard]] MeshData read_ensight(const std::string& file, const std::string& time);

}  // namespace tetraglass::mesh
