#pragma once

#include "support/meshes.h"

namespace tetraglass::tests {

/// The sum over all cells; those that are turned inside out count less than nothing.
inline double total_volume(const mesh::TetMesh& mesh) {
  double sum = 0;
  for (const mesh::Cell& cell : mesh.cells) sum += volume(mesh, cell);
  return sum;
}

}  // namespace tetraglass::tests
