#pragma once

#include <vector>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Several meshes as one, without joining their points. Fields of the same name, place and number
/// of components become one, with NaN in the meshes that lack it; where there are several meshes,
/// the cell field `part` (the last one) counts them from 0. Throws InputError where there is none.
[[nodiscard]] MeshData append_meshes(std::vector<MeshData> meshes);

}  // namespace tetraglass::mesh
