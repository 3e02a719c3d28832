#pragma once

#include <array>
#include <cstddef>

#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// How sound a mesh is: what `tetraglass info` tells.
struct Soundness {
  /// Cells of exactly no volume. Cells with a coordinate that is not finite are left to
  /// `nan_values`.
  std::size_t degenerate = 0;
  /// Coordinates of points and values (single components) of all fields that are not finite.
  std::size_t nan_values = 0;
  /// Face-connected components.
  std::size_t parts = 0;
  std::size_t boundary_faces = 0;
  /// Faces with more than two cells, or with a cell and its double: cells overlap there.
  std::size_t crowded_faces = 0;
  /// Decided exactly: there is one part, and its boundary is one closed surface of genus 0 whose
  /// every edge is convex or flat. Holes and cavities exclude it; so do boundary triangles of no
  /// area (undecided).
  bool convex = false;
  /// Decided exactly: the mesh is convex, and across every interior face the opposite vertex does
  /// not lie inside the circumsphere of the cell (Delaunay's lemma). Cells of no volume have no
  /// circumsphere; across their faces only the sphere of the neighbour is tested.
  bool delaunay = false;
  /// The smallest dihedral angle over the cells with volume; 0 if there are none.
  double min_dihedral_degrees = 0;
  /// The smallest dihedral angle of each cell with volume, in bins of 5 degrees over [0, 90).
  std::array<std::size_t, 18> dihedral_histogram{};
  /// The smallest radius ratio over the cells with volume (three times the radius of the inscribed
  /// over that of the circumscribed sphere: 1 for the regular tetrahedron); 0 if there are none.
  double min_radius_ratio = 0;
  /// The radius ratio of each cell with volume, in bins of 0.05 over [0, 1].
  std::array<std::size_t, 20> radius_ratio_histogram{};
};

/// Examines a mesh. Cost: linear but for the sort of the boundary edges; all parallel.
[[nodiscard]] Soundness check(const TetMesh& mesh);

}  // namespace tetraglass::mesh
