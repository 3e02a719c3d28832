#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

inline constexpr std::uint32_t kNoCell = 0xffffffffU;

/// The cell on the other side of each face, by cell and face (face i lies opposite vertex i); kNoCell on the boundary.
struct Adjacency {
  std::vector<std::array<std::uint32_t, 4>> neighbors;
  std::size_t boundary_faces = 0;
  std::size_t crowded_faces = 0;  ///< faces with more than two cells; they are linked to none
};

/// Cost: linear on average; in parallel.
[[nodiscard]] Adjacency face_adjacency(const TetMesh& mesh);

}  // namespace tetraglass::mesh
