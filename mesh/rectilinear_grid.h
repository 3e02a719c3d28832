#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh_data.h"
#include "mesh/tet_mesh.h"

namespace tetraglass::mesh {

/// A grid of points along three straight axes (not necessarily at right angles), the first fastest;
/// evenly spaced or not. Point (i, j, k) lies at
/// origin + axes (coordinates[0][i], coordinates[1][j], coordinates[2][k]).
struct RectilinearGrid {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  /// Increasing, from 0. Of an evenly spaced axis 0, 1, 2, ... (its column is the step), else in
  /// the mesh's units of length (its column has length 1).
  std::array<std::vector<double>, 3> coordinates;
  std::array<bool, 3> even{};  ///< evenly spaced along this axis

  [[nodiscard]] std::size_t size(std::size_t axis) const { return coordinates[axis].size(); }

  /// The place in units of points: whole numbers at points, linear in between, bounded to the grid.
  [[nodiscard]] Eigen::Vector3d index_at(const Eigen::Vector3d& coordinate) const;
};

/// The grid that the points of `mesh` are: what `decompose` makes of images and rectilinear grids.
/// The values of point fields then lie in the grid's order, and need no copy. Points may be off by
/// the rounding of single precision. Throws InputError where the points are no such grid
/// (curvilinear grids, unstructured meshes), and where its tetrahedra do not fill every voxel
/// (blanked ones). A mesh without cells is taken for whole (ImportOptions::grid_only). Cost:
/// linear.
[[nodiscard]] RectilinearGrid rectilinear_grid(const TetMesh& mesh);

/// The same of cells that have not been split: a voxel or hexahedron in each voxel. Others of
/// dimension 3 are refused, those below are passed over.
[[nodiscard]] RectilinearGrid rectilinear_grid(const MeshData& data);

/// The trilinear interpolation of one value per point at a place in units of points (index_at).
[[nodiscard]] double interpolate(const RectilinearGrid& grid, std::span<const double> values,
                                 const Eigen::Vector3d& index);

}  // namespace tetraglass::mesh
