#pragma once

#include <vector>

#include <Eigen/Core>

#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// The gradient of a linear point field in each cell, per unit length; zero for cell fields and in
/// cells of no volume or with values or coordinates that are not finite. One per cell of the mesh.
/// In parallel.
[[nodiscard]] std::vector<Eigen::Vector3d> cell_gradients(const TetMesh& mesh,
                                                          const ScalarField& field);

/// The volume-weighted mean of the gradients of the cells around each point; zero for cell fields
/// and where no cell around has volume. One per point. Cells with values or coordinates that are
/// not finite do not take part. In parallel; the result does not depend on the number of threads.
[[nodiscard]] std::vector<Eigen::Vector3d> vertex_gradients(const TetMesh& mesh,
                                                            const ScalarField& field);

}  // namespace tetraglass::mesh
