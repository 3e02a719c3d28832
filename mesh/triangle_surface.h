#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// A closed surface of triangles in shells (parts connected by edges). Within a shell neighbouring
/// triangles agree on their direction, where it is a manifold.
struct TriangleSurface {
  std::vector<Eigen::Vector3d> points;  ///< all different
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::vector<std::size_t>> shells;  ///< of each, its triangles
  std::size_t turned = 0;  ///< triangles whose direction disagreed with their neighbours'
};

/// The triangles of the cells of dimension 2: polygons are cut by the diagonals from their smallest
/// point, cells of higher order taken by their corners. Equal points become one; triangles that
/// name a point twice are left out. Both are told in `notes`. Throws InputError where coordinates
/// are not finite or the surface is open, with the number of edges that have an odd number of
/// triangles.
[[nodiscard]] TriangleSurface triangle_surface(const MeshData& data,
                                               std::vector<std::string>& notes);

/// The volume within, positive where faces turn outwards.
[[nodiscard]] double enclosed_volume(const TriangleSurface& surface);

}  // namespace tetraglass::mesh
