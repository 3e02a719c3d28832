#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// How sound a mesh is: what `tetraglass info` tells.
struct Soundness {
  std::size_t degenerate = 0;      ///< cells of exactly no volume
  std::size_t nan_values = 0;      ///< values and coordinates that are not finite, over all fields
  std::size_t parts = 0;           ///< face-connected components
  std::size_t boundary_faces = 0;
  std::size_t crowded_faces = 0;   ///< faces with more than two cells: overlapping or doubled cells
  bool convex = false;             ///< one part, and every boundary edge is convex or flat (exact), genus and cavities excluded
  bool delaunay = false;           ///< every interior face is locally Delaunay (exact) and the mesh is convex
  double min_dihedral_degrees = 0; ///< over the cells with volume; 0 if there are none
  std::array<std::size_t, 18> dihedral_histogram{};  ///< smallest dihedral angle of each cell, in bins of 5 degrees over [0, 90)
};

/// Cost: linear but for the sort of the faces. All parallel.
[[nodiscard]] Soundness check(const TetMesh& mesh);

}  // namespace tetraglass::mesh
