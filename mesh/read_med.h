#pragma once

#include <string>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Reads a MED file (.med, .rmed, .mmed: Salome, Code_Aster) by the MED library: its first
/// unstructured mesh of highest dimension, the numbers of the cells' families where there are any
/// (cell field `family`), and the fields at nodes and in cells of one time step (`time` as in
/// `find_time_step`; fields without time are always taken), with NaN where a field has no value.
/// Of values at integration points the mean of each cell is taken, and told. In a process of its
/// own, since the library trusts the sizes in such files. Throws ReadError.
[[nodiscard]] MeshData read_med(const std::string& file, const std::string& time);

}  // namespace tetraglass::mesh
