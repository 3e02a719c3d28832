#pragma once

#include "mesh/tet_mesh.h"
#include "sort/boundary_relations.h"

namespace tetraglass::sort {

/// Whether a ray leaves the mesh through `exit` and meets `entry` behind it: their images overlap
/// and `entry` is the farther one there. Decided exactly. `in_half_space` says that all six
/// vertices are known to lie in one open half-space bounded by a plane through the eye (always so
/// in parallel views); `farther` that all of `entry` is known to be at a greater depth than all of
/// `exit`.
[[nodiscard]] bool hides(const mesh::TetMesh& mesh, const BoundaryFace& exit,
                         const BoundaryFace& entry, const View& view, bool in_half_space,
                         bool farther);

}  // namespace tetraglass::sort
