#pragma once

#include <numeric>
#include <random>
#include <vector>

#include "mesh/tet_mesh.h"
#include "sort/order.h"

namespace tetraglass::sort {

inline std::vector<std::uint32_t> all_cells(const mesh::TetMesh& mesh) {
  std::vector<std::uint32_t> cells(mesh.cells.size());
  std::iota(cells.begin(), cells.end(), 0U);
  return cells;
}

inline View parallel(const Eigen::Vector3d& direction) {
  return {true, Eigen::Vector3d::Zero(), direction.normalized()};
}
inline View from(const Eigen::Vector3d& eye) {
  return {false, eye, -Eigen::Vector3d::UnitZ()};
}

/// Random views in turn: parallel, an eye outside the mesh's bounds, one inside them.
inline std::vector<View> random_views(const mesh::TetMesh& mesh, std::size_t count) {
  const mesh::Box box = mesh::bounds(mesh);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<View> views;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d v(unit(random), unit(random), unit(random));
    if (i % 3 == 0) views.push_back(parallel(v));
    if (i % 3 == 1) views.push_back(from(box.center() + box.diagonal().norm() * v.normalized()));
    if (i % 3 == 2) views.push_back(from(box.center() + 0.5 * box.diagonal().cwiseProduct(v)));
  }
  return views;
}

}  // namespace tetraglass::sort
