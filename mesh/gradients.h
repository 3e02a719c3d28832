#pragma once

#include <vector>

#include <Eigen/Core>

#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// The gradient of a linear point field in each cell, per unit length; zero in cells of no volume and for cell fields.
/// In parallel, one per cell of the mesh.
[[nodiscard]] std::vector<Eigen::Vector3d> cell_gradients(const TetMesh& mesh, const ScalarField& field);

/// The volume-weighted mean of the gradients of the cells around each point; zero where a point has none. One per point.
/// Cells with values that are not finite do not take part.
[[nodiscard]] std::vector<Eigen::Vector3d> vertex_gradients(const TetMesh& mesh, const ScalarField& field);

}  // namespace tetraglass::mesh
