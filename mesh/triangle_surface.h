#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// A surface of triangles.
struct TriangleSurface {
  std::vector<Eigen::Vector3d> points;  ///< all different
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> sources;  ///< of each point, its number in the data
  std::vector<std::uint32_t> cells;    ///< of each triangle, the number of its cell in the data
  std::vector<std::vector<std::size_t>> shells;  ///< of each, its triangles
  std::size_t turned = 0;  ///< triangles whose direction disagreed with their neighbours'
  /// Whether some edge has three triangles, or another odd number above: walls within the solid,
  /// which part it into regions, so that directions say nothing.
  bool inner_walls = false;
};

/// The triangles of the cells of dimension 2, as they are, without shells: polygons are cut by the
/// diagonals from their smallest point, cells of higher order taken by their corners. Equal points
/// become one; triangles that name a point twice are left out. Both are told in `notes`. Throws
/// InputError where coordinates are not finite.
[[nodiscard]] TriangleSurface collect_triangles(const MeshData& data,
                                                std::vector<std::string>& notes);

/// The surface of `collect_triangles` where it is closed, in shells (parts connected by edges).
/// Within a shell neighbouring triangles agree on their direction, where it is a manifold. Throws
/// InputError where an edge has one triangle only, with a diagnosis (surface_diagnosis.h).
[[nodiscard]] TriangleSurface triangle_surface(const MeshData& data,
                                               std::vector<std::string>& notes);

/// The triangles at an edge, and whether each runs from the smaller to the larger point.
struct EdgeUse {
  std::size_t triangle;
  bool forward;
};

/// The edges of triangles by their points, the smaller first, in that order.
[[nodiscard]] std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<EdgeUse>> find_edges(
    std::span<const std::array<std::uint32_t, 3>> triangles);

/// The volume within, positive where faces turn outwards.
[[nodiscard]] double enclosed_volume(const TriangleSurface& surface);

}  // namespace tetraglass::mesh
