#pragma once

#include <vector>

#include "mesh/triangle_surface.h"

namespace tetraglass::mesh {

/// Whether a place belongs to the solid that a surface bounds, from how often its shells go round
/// it: `total` counts a shell positively where its faces turn outwards, `crossings` is the number
/// of triangles on a ray from it.
[[nodiscard]] inline bool is_solid(const TriangleSurface& surface, int total, int crossings) {
  // Where directions disagree they say nothing, and shells within shells bound cavities.
  return surface.turned > 0 ? crossings % 2 != 0 : total != 0;
}

/// Points of a body-centred cubic lattice within the solid, about one for 6 cells of the given
/// volume (of which its Delaunay tetrahedra, that are all alike and nearly regular, would have 6
/// per point), and none nearer to the surface than half a step. The lattice is turned, so that it
/// has no plane in common with the faces of boxes. Cost: linear in the triangles and points.
[[nodiscard]] std::vector<Eigen::Vector3d> interior_points(const TriangleSurface& surface,
                                                           double volume_of_cell);

}  // namespace tetraglass::mesh
