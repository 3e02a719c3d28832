#pragma once

#include <cstddef>

namespace tetraglass::mesh {

/// Throws InputError, with both sizes, where a mesh of that many points and cells (eight corners
/// each, split into six tetrahedra) needs more memory than this machine has, or more numbers than
/// 32 bits give. For sizes that a file only claims: asking before allocating.
void check_mesh_fits(std::size_t points, std::size_t cells);

}  // namespace tetraglass::mesh
