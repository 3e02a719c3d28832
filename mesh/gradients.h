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

/// The gradients at the points by least squares: of the linear functions through the value of each
/// point, that which comes nearest to the values at its neighbours (the other points of the cells
/// around it), weighted by the inverse squared distance (of a thousandth of the farthest at least).
/// Flat cells and slivers count no more than others: where the neighbours lie in a plane or line,
/// the gradient lies in it too (the solution of least norm). Exact for linear fields; zero as in
/// vertex_gradients. Source: Correa, Hero and Ma 2011, "A Comparison of Gradient Estimation Methods
/// for Volume Rendering on Unstructured Meshes". Cost: a decomposition of a matrix of some 15 x 3
/// numbers per point, in parallel.
[[nodiscard]] std::vector<Eigen::Vector3d> least_squares_gradients(const TetMesh& mesh,
                                                                   const ScalarField& field);

}  // namespace tetraglass::mesh
