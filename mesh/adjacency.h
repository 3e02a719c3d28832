#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

inline constexpr std::uint32_t kNoCell = 0xffffffffU;

/// The cell on the other side of each face, by cell and face (face i lies opposite vertex i);
/// kNoCell on the boundary and at crowded faces.
struct Adjacency {
  std::vector<std::array<std::uint32_t, 4>> neighbors;
  /// Faces with one cell.
  std::size_t boundary_faces = 0;
  /// Triangles with more than two cells, one cell twice (whose vertices repeat), or two cells of
  /// the same four vertices (doubles, which lie on the same side of them); they are linked to none.
  std::size_t crowded_faces = 0;
};

/// Which faces of the cells have the same three vertices. Cost: linear on average, in parallel;
/// about 64 bytes of working memory per cell.
[[nodiscard]] Adjacency face_adjacency(const TetMesh& mesh);

}  // namespace tetraglass::mesh
