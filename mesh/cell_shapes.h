#pragma once

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// What is known of a cell type without looking at a mesh.
struct CellShape {
  CellType type;
  const char* name;
  int dimension;
  int corners;  ///< 0 where each cell has its own number
  int points;   ///< 0 where each cell has its own number (at least `corners`)
};

/// The shape of a cell type; null if it is unknown.
[[nodiscard]] const CellShape* find_shape(CellType type);

}  // namespace tetraglass::mesh
